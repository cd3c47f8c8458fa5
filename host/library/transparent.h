#pragma once
// What is transparent after the lens holds no light.
#include <span>
#include <vector>

#include "frame/frame.h"

namespace defray {

/// Rounding leaves traces of light where alpha is 0: takes them out of `after`, unless there was
/// such light before the lens, as that of flames is. Alpha may be one of the planes.
void clear_transparent(const Planes& before, std::span<const float> alpha_before,
                       std::vector<Plane>& after, const Plane& alpha_after);

/// Of a frame with an alpha of its own and its picture; others stay as they are.
void clear_transparent(const Frame& before, std::vector<Plane>& after);

}  // namespace defray
