#pragma once
// Ray tracing of the built-in scenes: the pinhole picture, and what lenses make of them. All of it
// runs on every core, and gives the same bits on any number of them.
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/plane.h"
#include "defray/report.h"
#include "measure/metrics.h"
#include "scenes/scene.h"

namespace defray {

/// Depth where nothing is hit, as Cycles writes it.
constexpr double nothing_there = 1e10;

struct ScenePicture {
  std::vector<Plane> colour;  ///< R G B; where the scene has no background, premultiplied by alpha.
  Plane depth;                ///< Planar; `nothing_there` where nothing is hit.
  Plane alpha;                ///< Share of the rays that hit something.
};

/// How a pinhole camera samples a pixel.
struct PinholeSampling {
  /// Rays spread evenly over the pixel's square, the same in each pixel; 1: through its centre.
  int samples = 1;
  /// Depth is the mean over the same rays, with `nothing_there` for those that hit nothing, as
  /// renderers do that filter depth like colour. Else it is that of the pixel's centre.
  bool averages_depth = false;
};

/// What a lens makes of a scene, and how sure that is.
struct Truth {
  std::vector<Plane> colour;  ///< R G B: the mean of two halves with samples of their own.
  Plane alpha;                ///< Share of the rays that hit something.
  /// One half against the other; the mean's own error is about 6 dB less (where few pixels are
  /// clipped: highlights hide theirs). Empty for 1 sample.
  std::optional<Comparison> noise;
  /// The same for alpha, as half the difference of the halves, which is about as large as the
  /// mean's own error. 0 for 1 sample.
  double alpha_noise_rms = 0, alpha_noise_worst = 0;
};

/// What a renderer's pinhole camera gives. At a straight edge, colour and alpha are right to
/// 1.5/samples where it is level or upright, to samples^-3/4 where it slants. Throws Error(usage)
/// unless 1 <= samples <= 65536.
ScenePicture render_pinhole(const Scene& scene, const PinholeSampling& sampling = {});

/// The second layer: what the pinhole's rays enter next, behind the surface they hit first.
/// Background where there is nothing more.
ScenePicture render_hidden(const Scene& scene);

/// What the two surfaces are that each pixel's square shows.
struct Coverage {
  ScenePicture front;   ///< Mean over what the nearer surface covers.
  ScenePicture behind;  ///< Mean over the rest; where there is none, as render_hidden.
  Plane share;          ///< Of the square that the nearer surface covers; 1 away from silhouettes.
};

/// A pixel's rays (as of render_pinhole) part where their depths, in order, leave the widest gap,
/// by ratio; not where that is at most 1 + step, as at a slanting surface. Throws Error(usage)
/// unless 1 <= samples <= 65536, and step is finite and >= 0.
Coverage render_coverage(const Scene& scene, int samples, double step = 0.1);

/// Throws Error(usage) naming the option unless 1 <= samples <= 65536.
void check_samples(const std::string& name, int samples);

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
