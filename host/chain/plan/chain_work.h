#pragma once
// What the stages of the chain share: settings, plan, report, and the rows that each has done.
#include <algorithm>

#include "base/stopwatch.h"
#include "chain/plan/chain_bands.h"
#include "chain/tiles/tile_classes.h"
#include "defray/options.h"
#include "defray/report.h"
#include "frame/backend.h"
#include "rdb/rdb.h"

namespace defray {

/// A stage's own planes, [height][layers][width], have room for all rows; those that it has not
/// done yet, and those that nobody needs any more, take no memory.
struct ChainWork {
  ChainWork(const ChainSettings& s, Backend& b) : settings(s), backend(b) {}

  const ChainSettings& settings;
  Backend& backend;
  RayPlan plan = {};
  ChainReach reach = {};
  ChainBands bands = {};
  bool is_banded = false;  ///< Whether there are several.
  ChainReport report = {};
  TileClasses tiles = {};

  /// The stage that ends here; one that comes back adds to its time.
  void done(const char* stage) {
    backend.finish();
    const double seconds = watch_.lap();
    const auto found = std::find_if(report.stages.begin(), report.stages.end(),
                                    [&](const StageTime& s) { return s.stage == stage; });
    const std::size_t made = backend.bytes_made(), bytes = made - bytes_;
    bytes_ = made;
    if (found == report.stages.end()) {
      report.stages.push_back({stage, seconds, bytes});
    } else {
      found->seconds += seconds;
      found->bytes += bytes;
    }
  }

 private:
  std::size_t bytes_ = backend.bytes_made();
  Stopwatch watch_;
};

/// The rows up to `end` that a stage has not done yet, in whole steps; from now on it has.
inline Rows go_on(int& done, int end, int height) {
  const Rows rows{done, std::min(height, (end + band_step - 1) / band_step * band_step)};
  done = std::max(done, rows.end);
  return rows;
}

/// Rows that nobody needs any more, of planes of a frame.
template <typename T>
void give_back(const Frame& f, Rows rows, Values<T>& plane) {
  if (plane.empty() || rows.empty()) return;
  const std::size_t first = f.index(0, rows.y);
  plane.give_back(first, f.index(0, rows.end) - first);
}
inline void give_back(const Frame& f, Rows rows, Planes& planes) {
  for (Values<float>& plane : planes) give_back(f, rows, plane);
}

/// Rows given back once; `kept` is the first that was not.
inline Rows not_needed(int& kept, int end) {
  const Rows rows{kept, std::max(kept, end)};
  kept = rows.end;
  return rows;
}

}  // namespace defray
