#pragma once
// Ray tracing of the built-in scenes: the pinhole picture, and what lenses make of them. All of it
// runs on every core, and gives the same bits on any number of them.
#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "metrics.h"
#include "rdb.h"
#include "scenes/scene.h"

namespace defray {

/// Depth where nothing is hit, as Cycles writes it.
constexpr double nothing_there = 1e10;

struct ScenePicture {
  std::vector<Plane> colour;  ///< R G B.
  Plane depth;                ///< Planar; `nothing_there` where nothing is hit.
};

/// What a lens makes of a scene, and how sure that is.
struct Truth {
  std::vector<Plane> colour;  ///< R G B: the mean of two halves with samples of their own.
  /// One half against the other; the mean's own error is about 6 dB less (where few pixels are
  /// clipped: highlights hide theirs). Empty for 1 sample.
  std::optional<Comparison> noise;
};

/// Gets the share done, 0 to 1.
using Progress = std::function<void(double)>;

/// What a renderer's pinhole camera gives: one ray through each pixel's centre.
ScenePicture render_pinhole(const Scene& scene);

/// The second layer: what the pinhole's rays enter next, behind the surface they hit first.
/// Background where there is nothing more.
ScenePicture render_hidden(const Scene& scene);

/// Throws Error(usage) unless 1 <= samples <= 65536.
void check_truth_samples(int samples);

/// What the lens gives: the scene traced through `samples` stratified points of the aperture and
/// of the pixel's square, for each pixel. Throws Error(usage) unless 1 <= samples <= 65536.
Truth render_truth(const Scene& scene, const Lens& lens, int samples, std::uint32_t seed,
                   const Progress& progress = {});

/// The accumulation buffer of Haeberli & Akeley 1990: the mean of one view through the pixels'
/// centres from each point of the lens (unit disc), the same points for all pixels. R G B.
/// Throws Error(usage) without points.
std::vector<Plane> render_accumulation(const Scene& scene, const Lens& lens,
                                       const std::vector<std::array<double, 2>>& lens_points,
                                       const Progress& progress = {});

}  // namespace defray
