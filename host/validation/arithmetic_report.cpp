#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "measure/plot.h"
#include "validation/arithmetic.h"

namespace defray::validation {
namespace {

std::string decibels(double psnr_db) {
  return std::isinf(psnr_db) ? "equal" : fmt::format("{:.1f}", psnr_db);
}

Table method_table(const std::vector<VariantResult>& results) {
  Table table{"",
              "Whole renders against the strict ones (fence, focus on the background)",
              {"variant", "method", "time", "spread", "PSNR, dB", "worst value",
               "values changed, %", "same bits for every work-group"},
              {}};
  for (const VariantResult& r : results) {
    for (const MethodFigures& m : r.methods) {
      table.rows.push_back({r.name, m.method, fmt::format("x {:.2f}", m.time_ratio),
                            fmt::format("{:.2f}", m.time_spread), decibels(m.psnr_db),
                            fmt::format("{:.2g}", m.worst), fmt::format("{:.2f}", 100 * m.changed),
                            m.is_stable ? "yes" : "no"});
    }
  }
  return table;
}

Table kernel_table(const std::vector<VariantResult>& results) {
  Table table{"",
              "Kernels against the scalar twins (quick grid): what of the strict rule is left",
              {"variant", "kernel", "time", "rule", "values differing, %", "largest ulp or share",
               "cases with other bits in a second run"},
              {}};
  for (const VariantResult& r : results) {
    for (const KernelResult& k : r.kernels.kernels) {
      const auto time = r.kernel_time_ratio.find(k.kernel);
      const double share = 100.0 * static_cast<double>(k.verdict.differing) /
                           static_cast<double>(std::max<std::uint64_t>(k.verdict.compared, 1));
      table.rows.push_back(
          {r.name, k.kernel,
           time == r.kernel_time_ratio.end() ? "-" : fmt::format("x {:.2f}", time->second),
           k.error.empty() ? (k.passed() ? "kept" : "broken") : "error",
           fmt::format("{:.3g}", share), fmt::format("{:.3g}", k.verdict.worst),
           std::to_string(k.unstable)});
    }
  }
  return table;
}

/// Time over error; equal pictures at the right edge.
Plot trade_plot(const std::vector<VariantResult>& results) {
  constexpr double equal_db = 160;
  Plot plot{"Time against the strict render's, and distance from it",
            "PSNR to the strict render, dB (160: equal)", "time / strict time"};
  for (const VariantResult& r : results) {
    Series series{r.name, {}, false, true};
    for (const MethodFigures& m : r.methods) {
      series.points.push_back({std::min(m.psnr_db, equal_db), m.time_ratio});
    }
    if (!series.points.empty()) plot.series.push_back(series);
  }
  return plot;
}

}  // namespace

Section to_section(const std::vector<VariantResult>& results, const std::string& folder) {
  Section section{"Arithmetic: what relaxing it buys and costs",
                  "Times are medians of ratios to the strict build in the same round.",
                  {},
                  {},
                  {}};
  for (const VariantResult& r : results) {
    section.findings.push_back(r.error.empty()
                                   ? fmt::format("{}: {}", r.name, r.about)
                                   : fmt::format("{}: not on this device: {}", r.name, r.error));
  }
  section.tables = {method_table(results), kernel_table(results)};
  write_plot(folder + "/arithmetic.png", trade_plot(results));
  section.figures = {{"arithmetic.png", "Left: far from the strict picture. Low: fast."}};
  return section;
}

std::string to_json(const std::vector<VariantResult>& results) {
  using nlohmann::ordered_json;
  ordered_json list = ordered_json::array();
  for (const VariantResult& r : results) {
    ordered_json methods = ordered_json::array(), kernels = ordered_json::array();
    for (const MethodFigures& m : r.methods) {
      methods.push_back({{"method", m.method},
                         {"time_ratio", m.time_ratio},
                         {"time_spread", m.time_spread},
                         {"psnr_srgb_db", m.psnr_db},  // null: equal
                         {"worst", m.worst},
                         {"changed", m.changed},
                         {"stable", m.is_stable}});
    }
    for (const KernelResult& k : r.kernels.kernels) {
      ordered_json entry = {{"kernel", k.kernel},
                            {"keeps_rule", k.passed()},
                            {"differing", k.verdict.differing},
                            {"values", k.verdict.compared},
                            {"worst", k.verdict.worst},
                            {"unstable_cases", k.unstable}};
      const auto time = r.kernel_time_ratio.find(k.kernel);
      if (time != r.kernel_time_ratio.end()) entry["time_ratio"] = time->second;
      kernels.push_back(entry);
    }
    list.push_back({{"variant", r.name},
                    {"about", r.about},
                    {"error", r.error},
                    {"methods", methods},
                    {"kernels", kernels}});
  }
  return list.dump(1) + "\n";
}

}  // namespace defray::validation
