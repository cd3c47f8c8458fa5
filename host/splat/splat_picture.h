#pragma once
// The hierarchy through the lens: cut, project, order, resolve.
#include <vector>

#include "defray/splat.h"
#include "frame/backend.h"
#include "splat/hierarchy.h"
#include "splat/splats.h"

namespace defray {

/// `report` gets counts, depths and times. `transparency`: what all points let through.
SplatPlanes draw_splats(Backend& backend, const Hierarchy& tree, const DefraySplatParams& params,
                        bool lod, double transparency, SplatReport& report,
                        const Progress& progress = {});

/// What the paper compares with: the mean of sharp pictures from points all over the lens, each of
/// which shows the plane of focus in the same place (its figure 6 has 200). Of surfaces each is
/// drawn by itself, and in each pixel the nearer is over the farther: no splats of two surfaces
/// merge. R G B A.
std::vector<Plane> mean_of_views(Backend& backend, const std::vector<const Hierarchy*>& surfaces,
                                 const DefraySplatParams& params, int views,
                                 const Progress& progress = {});

}  // namespace defray
