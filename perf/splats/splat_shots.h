#pragma once
// Point clouds before a camera, for what is measured of them.
#include <string>
#include <vector>

#include "bench.h"
#include "splat/hierarchy.h"
#include "splat/splat_picture.h"

namespace defray::perf {

/// A built-in model and where it is seen from, on the z axis, in focus at its middle.
struct SplatShot {
  std::string name;
  double distance;
  Hierarchy tree;
};

Hierarchy tree_of(const PointCloud& cloud);

/// `points`: 0: the model's own number.
SplatShot make_splat_shot(const std::string& name, double distance, std::size_t points);

/// A picture of this size through an aperture.
DefraySplatParams splat_view(const SplatShot& shot, int width, int height, double aperture_mm,
                             const SplatSettings& settings = {});

/// One way of drawing, measured.
struct SplatRun {
  SplatReport report;
  Timing timing;
  std::vector<Plane> picture;
};

/// Throws Error(internal) where a picture is not that of the run before.
SplatRun run_splats(const Bench& bench, const SplatShot& shot, const DefraySplatParams& view,
                    bool lod);

}  // namespace defray::perf
