#pragma once
// Noise in given places and normals.
#include "splat/surfels/cloud_points.h"

namespace defray {

/// Moves points along their normals to where those around say that their surface is, and turns
/// normals likewise. Of planes, spheres and cylinders, as of all that curves evenly, nothing
/// changes. What lies beyond a ridge says nothing.
void smooth(CloudPoints& cloud);

}  // namespace defray
