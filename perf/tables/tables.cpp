#include "tables/tables.h"

#include "base/text.h"
#include "experiments.h"

namespace defray::perf {

const std::vector<Setup>& TableBench::setups() {
  if (!setups_) setups_ = make_setups(bench_);
  return *setups_;
}

const Section& TableBench::splats() {
  if (!splats_) splats_ = experiments().at("splat-table1").run(bench_);
  return *splats_;
}

const std::map<std::string, ReadmeTable>& readme_tables() {
  static const std::map<std::string, ReadmeTable> all{
      {"accuracy", {"error and time of every method, plate1 and --scenes", measure_accuracy}},
      {"methods", {"the same on three built-in scenes", measure_methods}},
      {"stages", {"what the stages around the RDB gain and cost", measure_stages}},
      {"left", {"what is left of the error", measure_left}},
      {"motion", {"error of the change from frame to frame", measure_motion}},
      {"layered", {"the default beside others on random layers", measure_layered}},
      {"prediction", {"expected errors beside true ones, and of --scenes", measure_prediction}},
      {"roofline", {"kernels beside the machine's memory and arithmetic", measure_roofline}},
      {"splats", {"point clouds: time and error by aperture", measure_splats}},
      {"splat-ratios", {"the same at the largest aperture, in short", measure_splat_ratios}},
      {"splat-speed", {"point clouds: time by points and pixels", measure_splat_speed}},
      {"splat-close", {"point clouds: surfaces close to each other", measure_close_splats}},
      {"papers", {"the papers' claims beside our figures", measure_papers}},
      {"arithmetic", {"relaxed builds of the kernels", measure_arithmetic}},
      {"validate", {"kernels against twins on every device", measure_validation}},
      {"tuning", {"work-groups: what 'defray tune' found", measure_tuning}},
      {"speed", {"rays a second (defray_benchmark)", measure_speed}}};
  return all;
}

std::string to_markdown(const Figures& figures) {
  const auto line = [](const std::vector<std::string>& cells) {
    return "| " + join(cells, " | ") + " |\n";
  };
  std::string text = line(figures.table.columns);
  for (std::size_t i = 0; i < figures.table.columns.size(); ++i) text += "|---";
  text += "|\n";
  for (const auto& row : figures.table.rows) text += line(row);
  for (const std::string& note : figures.notes) text += "\n" + note + "\n";
  return text;
}

}  // namespace defray::perf
