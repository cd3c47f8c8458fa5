#include "validation/report.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "measure/plot.h"

namespace defray::validation {
namespace {

const char* pass_word(bool passed) { return passed ? "PASS" : "FAIL"; }

/// "0", "3 ulp", "2".
std::string worst_text(const KernelResult& k) {
  if (k.verdict.worst == 0) return "0";
  if (k.verdict.has_floats()) return fmt::format("{:.0f} ulp", k.verdict.worst);
  return fmt::format("{:.0f}", k.verdict.worst);
}

std::string hash_text(const KernelResult& k) { return fmt::format("{:016x}", k.hash); }

Table summary(const std::vector<DeviceResult>& devices) {
  Table table{
      "", "PASS: every value within its rule, and the same bits in every run.", {"kernel"}, {}};
  for (const DeviceResult& d : devices) table.columns.push_back(d.device);
  const bool has_others = devices.size() > 1;
  if (has_others) table.columns.push_back("same bits on all");
  for (std::size_t i = 0; i < devices.front().kernels.size(); ++i) {
    const KernelResult& first = devices.front().kernels[i];
    std::vector<std::string> row{first.kernel};
    bool is_same = true;
    for (const DeviceResult& d : devices) {
      row.push_back(pass_word(d.kernels[i].passed()));
      is_same = is_same && d.kernels[i].hash == first.hash && d.kernels[i].cases == first.cases;
    }
    if (has_others) row.push_back(is_same ? "yes" : "no");
    table.rows.push_back(row);
  }
  return table;
}

Table kernel_table(const DeviceResult& device) {
  Table table{"",
              "Kernels against their scalar twins",
              {"kernel", "result", "rule", "cases", "values", "differing", "beyond the rule",
               "worst", "share of the exact bound", "unstable", "seconds", "hash"},
              {}};
  for (const KernelResult& k : device.kernels) {
    const Verdict& v = k.verdict;
    table.rows.push_back(
        {k.kernel, pass_word(k.passed()), k.rule, std::to_string(k.cases),
         std::to_string(v.compared), std::to_string(v.differing), std::to_string(v.wrong),
         worst_text(k), v.exact_share > 0 ? fmt::format("{:.3f}", v.exact_share) : "-",
         std::to_string(k.unstable), fmt::format("{:.1f}", k.seconds), hash_text(k)});
  }
  return table;
}

/// Where to look: a command for each kernel's worst and first wrong case.
Table case_table(const DeviceResult& device, const CommandOf& command_of) {
  Table table{"", "Cases to run again", {"kernel", "what", "command"}, {}};
  for (const KernelResult& k : device.kernels) {
    const auto add = [&](const char* what, const std::string& text) {
      if (!text.empty()) table.rows.push_back({k.kernel, what, command_of(device, k.kernel, text)});
    };
    add("largest difference", k.worst_case);
    add("first beyond the rule", k.first_wrong);
    if (!k.error.empty()) table.rows.push_back({k.kernel, "OpenCL error", k.error});
  }
  return table;
}

Table histogram_table(const DeviceResult& device) {
  Table table{"", "Distances of floats in ulp: numbers of values", {"kernel"}, {}};
  std::size_t last = 0;
  for (const KernelResult& k : device.kernels) {
    for (std::size_t bin = 0; bin < ulp_bins; ++bin) {
      if (k.verdict.ulp_histogram[bin] > 0) last = std::max(last, bin);
    }
  }
  for (std::size_t bin = 0; bin <= last; ++bin) table.columns.push_back(ulp_bin_name(bin));
  for (const KernelResult& k : device.kernels) {
    if (!k.verdict.has_floats()) continue;
    std::vector<std::string> row{k.kernel};
    for (std::size_t bin = 0; bin <= last; ++bin) {
      row.push_back(std::to_string(k.verdict.ulp_histogram[bin]));
    }
    table.rows.push_back(row);
  }
  return table;
}

/// Measured rounding over the number of terms, below the bound's line.
void add_bound_plot(const DeviceResult& device, std::size_t index, const std::string& folder,
                    Section& section) {
  constexpr double least_drawn = 0.001;
  Plot plot{"Rounding of float sums against exact ones", "roundings that the derived bound allows",
            "largest error, in roundings of the largest input"};
  plot.x_log = plot.y_log = true;
  Series bound{"derived bound", {}, true, false};
  for (const char* kernel : {"rdb_merge", "linear_psf"}) {
    Series series{kernel, {}, false, true};
    for (const ExactPoint& p : device.exact) {
      if (p.kernel != kernel || p.share <= 0 || std::isinf(p.share)) continue;
      series.points.push_back({p.roundings, std::max(p.share * p.roundings, least_drawn)});
      bound.points.push_back({p.roundings, p.roundings});
    }
    if (!series.points.empty()) plot.series.push_back(series);
  }
  if (bound.points.empty()) return;
  plot.series.push_back(bound);
  const std::string file = fmt::format("bounds-{}.png", index);
  write_plot(folder + "/" + file, plot);
  section.figures.push_back(
      {file, "Every point is a case. Right sums stay below the line; below 0.001 is drawn there."});
}

constexpr const char* fast_note =
    "Fast arithmetic is not made to keep the strict rules: FAIL tells where it does not.";

/// `index`: among the devices; files of two must not meet.
Section device_section(const DeviceResult& device, std::size_t index, const std::string& folder,
                       const CommandOf& command_of) {
  Section section{device.device, "", {}, {}, {}};
  section.findings.push_back(fmt::format("{}, {}; {} arithmetic. {}", device.platform,
                                         device.version, device.math,
                                         device.passed() ? "All kernels pass." : "NOT all pass."));
  if (!device.watch.empty()) section.findings.push_back(device.watch);
  if (device.math == "fast") section.findings.push_back(fast_note);
  section.tables = {kernel_table(device)};
  for (Table& table : std::vector<Table>{case_table(device, command_of), histogram_table(device)}) {
    if (!table.rows.empty()) section.tables.push_back(std::move(table));
  }
  for (const WorstPicture& picture : device.pictures) {
    const std::string file = fmt::format("{}-worst-{}.png", picture.kernel, index);
    write_sheet(folder + "/" + file, picture.panels, picture.width, picture.height);
    section.figures.push_back(
        {file, picture.kernel + ", largest difference: " + picture.case_text});
  }
  add_bound_plot(device, index, folder, section);
  return section;
}

}  // namespace

std::vector<Section> to_sections(const std::vector<DeviceResult>& devices,
                                 const std::vector<std::string>& notes, const std::string& folder,
                                 const CommandOf& command_of) {
  Section top{"Summary", "Does this machine compute what the mathematics says?", notes, {}, {}};
  top.findings.push_back(
      "In the tables below: 'worst' is the largest difference from the twin, in ulp for floats, in "
      "steps for whole numbers (1/256 px for a radius). 'Share of the exact bound' is the largest "
      "error against exact arithmetic over what the rule allows: above 1 fails. 'Unstable' cases "
      "gave other bits in a second run. 'Hash' is of all results: equal where devices agree.");
  top.tables.push_back(summary(devices));
  std::vector<Section> sections{top};
  for (std::size_t i = 0; i < devices.size(); ++i) {
    sections.push_back(device_section(devices[i], i, folder, command_of));
  }
  return sections;
}

std::string to_json(const std::vector<DeviceResult>& devices, const std::vector<std::string>& notes,
                    const std::string& level, const CommandOf& command_of) {
  using nlohmann::ordered_json;
  ordered_json list = ordered_json::array();
  for (const DeviceResult& d : devices) {
    ordered_json kernels = ordered_json::array();
    for (const KernelResult& k : d.kernels) {
      const Verdict& v = k.verdict;
      ordered_json entry = {{"kernel", k.kernel},
                            {"passed", k.passed()},
                            {"rule", k.rule},
                            {"cases", k.cases},
                            {"values", v.compared},
                            {"differing", v.differing},
                            {"beyond_rule", v.wrong},
                            {"worst", v.worst},
                            {"worst_unit", v.has_floats() ? "ulp" : "integer"},
                            {"exact_share_of_bound", v.exact_share},
                            {"unstable_cases", k.unstable},
                            {"hash", hash_text(k)},
                            {"seconds", k.seconds}};
      if (v.has_floats()) {
        ordered_json bins;
        for (std::size_t bin = 0; bin < ulp_bins; ++bin) {
          if (v.ulp_histogram[bin] > 0) bins[ulp_bin_name(bin)] = v.ulp_histogram[bin];
        }
        entry["ulp_histogram"] = bins;
      }
      if (!k.worst_case.empty()) entry["worst_case"] = command_of(d, k.kernel, k.worst_case);
      if (!k.first_wrong.empty()) entry["first_wrong"] = command_of(d, k.kernel, k.first_wrong);
      if (!k.error.empty()) entry["error"] = k.error;
      kernels.push_back(entry);
    }
    list.push_back({{"device", d.device},
                    {"platform", d.platform},
                    {"version", d.version},
                    {"math", d.math},
                    {"watch", d.watch},
                    {"passed", d.passed()},
                    {"kernels", kernels}});
  }
  return ordered_json{{"level", level}, {"notes", notes}, {"devices", list}}.dump(1) + "\n";
}

}  // namespace defray::validation
