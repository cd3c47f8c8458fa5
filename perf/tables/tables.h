#pragma once
// The tables of figures in the READMEs, each measured by one function.
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "truth/truth.h"

namespace defray::perf {

/// What tables are measured with, and what several of them need.
class TableBench {
 public:
  explicit TableBench(Bench bench) : bench_(std::move(bench)) {}

  const Bench& bench() const { return bench_; }

  /// Those of the experiment `truth`, made when first asked for.
  const std::vector<Setup>& setups();
  /// The experiment `splat-table1`, made when first asked for.
  const Section& splats();

 private:
  Bench bench_;
  std::optional<std::vector<Setup>> setups_;
  std::optional<Section> splats_;
};

/// A table, and sentences that belong under it.
struct Figures {
  Table table;
  std::vector<std::string> notes;
};

Figures measure_accuracy(TableBench& bench);    ///< All methods, built-in plate1 and given scenes.
Figures measure_methods(TableBench& bench);     ///< All methods on three built-in scenes.
Figures measure_stages(TableBench& bench);      ///< Gain and cost of each stage of the RDB.
Figures measure_left(TableBench& bench);        ///< What is left of the default's error.
Figures measure_motion(TableBench& bench);      ///< From frame to frame.
Figures measure_layered(TableBench& bench);     ///< The default and others on random layers.
Figures measure_prediction(TableBench& bench);  ///< Expected errors beside true ones.
Figures measure_roofline(TableBench& bench);    ///< Kernels beside the machine's limits.
Figures measure_splats(TableBench& bench);      ///< Point clouds: time and error by aperture.
Figures measure_splat_ratios(TableBench& bench);  ///< The same at the largest aperture, in short.
Figures measure_splat_speed(TableBench& bench);   ///< The same: time by points and pixels.
Figures measure_close_splats(TableBench& bench);  ///< The same: surfaces close to each other.
Figures measure_papers(TableBench& bench);        ///< The papers' claims beside our figures.
Figures measure_arithmetic(TableBench& bench);    ///< Other builds of the kernels.
Figures measure_validation(TableBench& bench);    ///< Kernels against twins, on every device.
Figures measure_tuning(TableBench& bench);        ///< Work-groups: what `defray tune` found.
Figures measure_speed(TableBench& bench);         ///< Rays a second, by the benchmark beside us.

struct ReadmeTable {
  std::string about;
  Figures (*measure)(TableBench&);
};

/// Every table by the name that its markers have.
const std::map<std::string, ReadmeTable>& readme_tables();

/// As Markdown, each note a paragraph.
std::string to_markdown(const Figures& figures);

}  // namespace defray::perf
