#pragma once
// Sharp edges between faces of a surface.
#include "splat/surfels/cloud_points.h"

namespace defray {

/// Faces meet in a ridge where their normals differ by this cosine or less (25 degrees).
inline constexpr double ridge_cosine = 0.906;

/// Finds for points of what has normals, and one side, where their faces end at others (Zwicker,
/// Rasanen, Botsch, Dachsbacher & Pauly, Perspective accurate splatting, 2004).
void find_ridges(CloudPoints& cloud);

}  // namespace defray
