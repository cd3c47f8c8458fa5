#include "tune/tune_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "measure/heat_map.h"
#include "measure/html_report.h"

namespace defray::cli {
namespace {

using tuning::Finding;

/// "7 % (5 to 9 %)", what is won, and the quartiles of pairs of runs.
std::string gain_of(const Finding& f) {
  if (f.best == f.own) return "-";
  return fmt::format("{:.0f} % ({:.0f} to {:.0f} %)", 100 * f.gain(), 100 * (1 - f.high),
                     100 * (1 - f.low));
}

/// Times over the work-groups of a kernel on frames of a class.
HeatMap map_of(const TuneReport& report, const Finding& f) {
  std::set<std::size_t> xs, ys;
  std::vector<const tuning::Result*> tries;
  for (const tuning::Result& r : report.results) {
    if (r.place != f.place || r.run_ms.empty()) continue;
    tries.push_back(&r);
    xs.insert(r.shape.x);
    ys.insert(r.shape.y);
  }
  HeatMap map{fmt::format("{}: {}", f.place.kernel, f.place.picture),
              "x; ms, shortest run",
              "y",
              {},
              {},
              {}};
  for (const std::size_t x : xs) map.columns.push_back(std::to_string(x));
  for (const std::size_t y : ys) {
    map.rows.push_back(std::to_string(y));
    for (const std::size_t x : xs) {
      const auto is_this = [&](const auto* r) { return r->shape == tuning::Shape{x, y}; };
      const auto found = std::find_if(tries.begin(), tries.end(), is_this);
      map.values.push_back(found == tries.end() ? std::nullopt
                                                : std::optional(tuning::time_of(**found)));
    }
  }
  return map;
}

std::string file_of(std::size_t index, const Finding& f) {
  return fmt::format("{}-{}.png", index + 1, f.place.kernel);
}

std::string intro_of(const TuneReport& report) {
  return fmt::format(
      "Work-groups of kernels on {} ({}, {}). Any gives the same bits; times are those of a "
      "kernel's shortest run. The fastest is used where it and the kernel's own were run five "
      "times "
      "or more, it took 3 % less, and was faster in three of four pairs.",
      report.key.device, report.key.platform, report.key.driver);
}

/// What looks faster, but was not run often enough to be used; empty: nothing.
std::string unsure_of(const std::vector<Finding>& all) {
  std::size_t count = 0, most = 0;
  for (const Finding& f : all) {
    count += f.runs_missing > 0;
    most = std::max(most, f.runs_missing);
  }
  if (count == 0) return "";
  return fmt::format(
      "{} of the best {} not used yet: up to {} more {} needed to be sure; 'defray tune' again, or "
      "a larger --budget, goes on from here",
      count, count == 1 ? "is" : "are", most, most == 1 ? "run is" : "runs are");
}

/// "yes", "no", "no: 3 runs are missing".
std::string use_of(const Finding& f) {
  if (f.runs_missing == 0) return f.is_adopted ? "yes" : "no";
  return fmt::format("no: {} missing",
                     f.runs_missing == 1 ? "1 run is" : fmt::format("{} runs are", f.runs_missing));
}

}  // namespace

/// Those of a picture together.
std::vector<Finding> by_picture(std::vector<Finding> all) {
  for (auto at = all.begin(); at != all.end();) {
    const std::string picture = at->place.picture;
    at = std::stable_partition(at, all.end(),
                               [&](const Finding& f) { return f.place.picture == picture; });
  }
  return all;
}

void print_text(const TuneReport& report) {
  const std::vector<Finding> all = by_picture(report.findings);
  fmt::print("{}, {}\n", report.key.device, report.key.driver);
  if (all.empty()) {
    fmt::print("  nothing is tuned; 'defray tune' does it\n");
    return;
  }
  std::string picture;
  for (const Finding& f : all) {
    if (std::exchange(picture, f.place.picture) != f.place.picture) {
      fmt::print("  {}; for {} frames\n", picture, f.place.frame_class);
      fmt::print("    {:<20} {:>8} {:>9} {:>8} {:>9}  {:<20} {:>5} {:>5}\n", "kernel", "own", "ms",
                 "best", "ms", "gain, quartiles", "tried", "used");
    }
    fmt::print("    {:<20} {:>8} {:>9.3f} {:>8} {:>9.3f}  {:<20} {:>5} {:>5}\n", f.place.kernel,
               to_string(f.own), f.own_ms, to_string(f.best), f.best_ms, gain_of(f), f.tried,
               f.is_adopted ? "best" : "own");
  }
  fmt::print("  gains are of the shortest runs, quartiles of runs in pairs\n  {}\n", report.path);
  if (const std::string unsure = unsure_of(all); !unsure.empty()) fmt::print("  {}\n", unsure);
}

void print_json(const TuneReport& report) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const Finding& f : report.findings) {
    list.push_back({{"frames", f.place.frame_class},
                    {"picture", f.place.picture},
                    {"kernel", f.place.kernel},
                    {"own", to_string(f.own)},
                    {"own_ms", f.own_ms},
                    {"best", to_string(f.best)},
                    {"best_ms", f.best_ms},
                    {"gain", f.gain()},
                    {"gain_low", 1 - f.high},
                    {"gain_high", 1 - f.low},
                    {"tried", f.tried},
                    {"used", f.is_adopted},
                    {"runs_missing", f.runs_missing}});
  }
  const nlohmann::ordered_json json = {{"device", report.key.device},
                                       {"platform", report.key.platform},
                                       {"driver", report.key.driver},
                                       {"file", report.path},
                                       {"kernels", list}};
  fmt::print("{}\n", json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
}

void write_report(const std::string& folder, const TuneReport& report) {
  Table table{"tuning",
              "Own: the work-group that is built in.",
              {"frames", "picture", "kernel", "own", "ms", "best", "ms", "gain, quartiles", "tried",
               "used"},
              {}};
  Section section{"What was found", "", {}, {}, {}};
  const std::vector<Finding>& all = report.findings;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Finding& f = all[i];
    table.rows.push_back({f.place.frame_class, f.place.picture, f.place.kernel, to_string(f.own),
                          fmt::format("{:.3f}", f.own_ms), to_string(f.best),
                          fmt::format("{:.3f}", f.best_ms), gain_of(f), std::to_string(f.tried),
                          use_of(f)});
    write_heat_map(folder + "/" + file_of(i, f), map_of(report, f));
    section.figures.push_back(
        {file_of(i, f),
         fmt::format("{} on frames of class {}: built in {}, fastest {}", f.place.kernel,
                     f.place.frame_class, to_string(f.own), to_string(f.best))});
  }
  section.tables.push_back(std::move(table));
  write_page(folder, {"defray tune: " + report.key.device, intro_of(report), {section}});
}

}  // namespace defray::cli
