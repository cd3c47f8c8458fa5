// What `defray tune` has found on this device so far.
#include "tables/tables.h"
#include "tuning/tuning_file.h"

namespace defray::perf {

Figures measure_tuning(TableBench& b) {
  const DeviceInfo& info = b.bench().backend.session().info();
  const tuning::Key key = tuning::key_of(info);
  const auto known = tuning::read(tuning::path_of(key), key, info.max_work_group);
  Figures figures{
      {"", "", {"picture", "kernel", "own", "ms", "fastest", "ms", "gain, quartiles", "used"}, {}},
      {}};
  std::string picture;
  for (const tuning::Finding& f : tuning::findings(known.results, info.is_gpu())) {
    const bool is_own = f.best == f.own;
    figures.table.rows.push_back(
        {f.place.picture == picture ? "" : f.place.picture, "`" + f.place.kernel + "`",
         to_string(f.own), fmt::format("{:.1f}", f.own_ms), is_own ? "" : to_string(f.best),
         is_own ? "" : fmt::format("{:.1f}", f.best_ms),
         is_own ? "none"
                : fmt::format("{:.0f} % ({:.0f} to {:.0f})", 100 * f.gain(), 100 * (1 - f.high),
                              100 * (1 - f.low)),
         f.is_adopted ? "yes" : "no"});
    picture = f.place.picture;
  }
  if (figures.table.rows.empty()) figures.notes.push_back("Nothing is tuned: run `defray tune`.");
  return figures;
}

}  // namespace defray::perf
