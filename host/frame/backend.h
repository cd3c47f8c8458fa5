#pragma once
// Everything that kernels compute, behind one interface: a device runs the kernels
// (device/device_backend.h), and the scalar twins compute the same (reference/twin_backend.h).
#include <utility>
#include <vector>

#include "defray/report.h"
#include "frame/frame.h"
#include "kernels/params.h"

namespace defray {

struct GatherSettings;
struct Lens;
struct LightSources;
struct PatternSettings;
struct PatternShift;
struct RayPlan;
struct RayResult;

/// What is in front at each pixel, and what lies behind it. Frames of one layer.
struct Surfaces {
  Frame front, behind;
};

class Backend {
 public:
  virtual ~Backend() = default;

  /// Throws Error(device) if it is known that there is less host memory than a frame needs.
  virtual void require_memory(const Frame&, std::size_t /*bytes*/) {}

  /// Memory that a device has made so far.
  virtual std::size_t bytes_made() const { return 0; }

  /// Kernel `coc`: radii of depths, planar, > 0; anything else is background.
  virtual Quanta coc(const Lens& lens, int display_width_px, const Values<float>& depth) = 0;

  /// Kernel `tiltshift`: radii from the row alone, never negative.
  virtual Quanta tiltshift(const DefrayTiltshiftParams& params) = 0;

  // The chain before the rays, in order. Frames have coc_quanta, inverse and channels.

  /// Kernel `repair`: for each pixel the index of the one whose depth it should have, itself but
  /// for pixels of anti-aliased depth, which lie between two surfaces.
  virtual Words repair(const Frame& frame) = 0;

  /// Kernel `mixed`: 1 where a pixel has neighbours on another surface.
  virtual Words mixed(const Frame& frame) = 0;

  /// Kernel `fill`: what lies behind each pixel, as far as the lens can uncover it, looked for in 8
  /// or DEFRAY_FILL_DIRECTIONS directions; `inverse` is negative where nothing does.
  virtual Frame fill(const Frame& frame, const Words& mixed, int directions) = 0;

  /// Kernels `patterns_*`: colours behind moved towards what resembles them, elsewhere in the
  /// picture. `pixels` are patterns_pixels, `variance` is patterns_variance.
  virtual Frame patterns(const Frame& frame, Frame behind, const Words& pixels,
                         const Plane& variance, const std::vector<PatternShift>& shifts,
                         const PatternSettings& settings) = 0;

  /// Kernel `split`: mixed pixels taken apart. `behind` is what `fill` gave.
  virtual Surfaces split(const Frame& frame, const Words& mixed, Frame behind) = 0;

  /// Kernel `assemble`: both as the two layers of one frame with depth instead of `inverse`; what
  /// is in the margin was not seen. Not data_of.
  virtual Frame assemble(const Surfaces& surfaces) = 0;

  /// Kernel `highlights`: the share of its colour that each surface keeps, 1 but for highlights.
  /// The first `light_channels` channels are light; another is alpha. Needs coverage.
  virtual Values<float> highlights(const Frame& frame, int light_channels) = 0;

  /// Kernel `soften`: colours averaged over what one of `lens_points` stands for.
  virtual Planes soften(const Frame& frame, int lens_points) = 0;

  // Pictures.

  /// Kernels `rdb_*`, and `highlights_add` if there are lights: the ray distribution buffers.
  virtual RayResult rays(const Frame& frame, const RayPlan& plan,
                         const LightSources* lights = nullptr, const Progress& progress = {}) = 0;

  /// Kernel `linear_psf`: every pixel spread over its disc.
  virtual std::vector<Plane> linear(const Frame& frame, const Progress& progress = {}) = 0;

  /// Kernels `gather_*`: all passes.
  virtual std::vector<Plane> gather(const Frame& frame, const GatherSettings& settings,
                                    const Progress& progress = {}) = 0;
};

}  // namespace defray
