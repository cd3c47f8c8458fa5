#pragma once
// The camera's place and the lens, as splats need them.
#include "base/vec3.h"
#include "defray/splat.h"
#include "kernels/splat_params.h"

namespace defray {

/// Throws Error(usage).
void validate(const SplatSettings& settings);

/// What the kernels are told, but for `count`. Throws Error(usage) for a camera that looks nowhere
/// and for lenses that no splat can have.
DefraySplatParams splat_params(const CameraPose& pose, const std::array<double, 3>& origin,
                               const Lens& lens, const SplatSettings& settings);

/// Scene units, of the other fields.
float lens_radius_of(const DefraySplatParams& p);

/// Where Gaussians end, and what is left of them.
void put_cutoff(double cutoff, DefraySplatParams& p);

/// How far from its middle a camera sees a sphere of this radius with a tenth around it.
double framing_distance(double radius, const Lens& lens, const SplatSettings& settings);

/// The kernel's formula, in double. Signed radius at planar depth z > 0, px.
double splat_coc_px(const DefraySplatParams& params, double z);

}  // namespace defray
