// Rays a second of the RDB: what defray_benchmark, built beside us, measures.
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "tables/tables.h"

namespace defray::perf {
namespace {

using Json = nlohmann::json;

std::string benchmark_path() {
  const auto path =
      std::filesystem::read_symlink("/proc/self/exe").parent_path() / "defray_benchmark";
  if (!std::filesystem::exists(path)) {
    fail(ErrorKind::input, "{}: no such file; the table 'speed' needs it", path.string());
  }
  return path;
}

std::string output_of(const std::string& command) {
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
  std::string text;
  char buffer[4096];
  for (std::size_t n = 0; pipe && (n = fread(buffer, 1, sizeof buffer, pipe.get())) > 0;) {
    text.append(buffer, n);
  }
  return text;
}

Json run_benchmark(bool is_quick) {
  const std::string options = is_quick ? "--benchmark_repetitions=2 --benchmark_min_time=0.01 "
                                         "--benchmark_filter='coc.*radius:8/|twin.*radius:8'"
                                       : "--benchmark_repetitions=5";
  const std::string text = output_of(
      fmt::format("'{}' {} --benchmark_format=json --benchmark_report_aggregates_only=true",
                  benchmark_path(), options));
  const Json json = Json::parse(text, nullptr, false);
  if (json.is_discarded() || !json.contains("benchmarks")) {
    fail(ErrorKind::internal, "{}: failed, or its output is no JSON", benchmark_path());
  }
  return json["benchmarks"];
}

/// "rdb_merge" of "rdb_merge/width:640/height:480/radius:8/manual_time".
std::string stage_of(const std::string& run) { return run.substr(0, run.find('/')); }

/// "640×480, CoC radius 8" of the same.
std::string frame_of(const std::string& run) {
  int width = 0, height = 0, radius = 0;
  std::sscanf(run.c_str(), "%*[^/]/width:%d/height:%d/radius:%d", &width, &height, &radius);
  return fmt::format("{}×{}, CoC radius {}", width, height, radius);
}

/// Its counter, whatever it is called.
double rate_of(const Json& entry) { return entry.value("rays/s", entry.value("pixels/s", 0.0)); }

std::size_t index_of(std::vector<std::string>& names, const std::string& name) {
  const auto at = std::find(names.begin(), names.end(), name);
  if (at != names.end()) return static_cast<std::size_t>(at - names.begin());
  names.push_back(name);
  return names.size() - 1;
}

std::string label_of(const std::string& stage) {
  const std::map<std::string, std::string> labels{{"coc", "`coc` (pixels)"},
                                                  {"rdb_scatter", "`rdb_scatter`, with clearing"},
                                                  {"rdb_merge", "`rdb_merge`"},
                                                  {"rays_scatter", "rays, `--rays scatter`"},
                                                  {"rays_gather", "rays, `--rays gather`"},
                                                  {"scalar_twin", "scalar twin, one thread"}};
  const auto label = labels.find(stage);
  return label == labels.end() ? "`" + stage + "`" : label->second;
}

}  // namespace

Figures measure_speed(TableBench& b) {
  b.bench().step("speed: defray_benchmark");
  std::vector<std::string> stages, frames;
  std::map<std::pair<std::size_t, std::size_t>, std::string> cells;
  for (const Json& entry : run_benchmark(b.bench().is_quick)) {
    const std::string run = entry.at("run_name"), what = entry.at("aggregate_name");
    std::string& cell = cells[{index_of(stages, stage_of(run)), index_of(frames, frame_of(run))}];
    if (what == "median") cell = fmt::format("{:.0f}", 1e-6 * rate_of(entry));
    if (what == "cv") cell += fmt::format(" ± {:.0f} %", 100 * rate_of(entry));
  }
  Table table{"", "", frames, {}};
  table.columns.insert(table.columns.begin(), "stage");
  for (std::size_t s = 0; s < stages.size(); ++s) {
    std::vector<std::string> row{label_of(stages[s])};
    for (std::size_t f = 0; f < frames.size(); ++f) {
      row.push_back(cells.count({s, f}) ? cells[{s, f}] : "–");
    }
    table.rows.push_back(row);
  }
  return {table, {}};
}

}  // namespace defray::perf
