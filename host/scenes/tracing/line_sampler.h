#pragma once
// Truths of scenes of flat shapes alone, along lines instead of single rays: all but free of noise.
#include <cmath>
#include <optional>

#include "base/random.h"
#include "scenes/geometry/flat_shapes.h"
#include "scenes/tracing/tracer.h"

namespace defray {

/// Light and coverage, of one ray or summed over many.
struct Exposure {
  Vec3 colour;
  double alpha = 0;
};

inline double fraction(double value) { return value - std::floor(value); }

/// Points of a pixel's square: the R2 sequence (Roberts 2018), shifted at random.
class PixelPoints {
 public:
  PixelPoints(int x, int y, Random& random)
      : x_(x), y_(y), shift_x_(random.next()), shift_y_(random.next()) {}
  std::array<double, 2> point(int i) const {
    return {x_ + fraction(shift_x_ + 0.7548776662466927 * i),
            y_ + fraction(shift_y_ + 0.5698402909980532 * i)};
  }

 private:
  double x_, y_, shift_x_, shift_y_;
};

/// Each sample is a level chord of the lens, along which rays run while they cross the pixel from
/// side to side. What each shape covers of it is a stretch with ends in closed form.
class LineSampler {
 public:
  /// None where a scene has anything but flat shapes.
  static std::optional<LineSampler> of(const Scene& scene, const Lens& lens);

  /// The mean over a pixel's square and the aperture.
  Exposure pixel(int x, int y, int samples, Random random) const;

 private:
  LineSampler(const Scene& scene, const Lens& lens) : tracer_(scene), lens_(lens) {}
  struct Line;
  Exposure along(const Line& line) const;

  Tracer tracer_;
  Lens lens_;
  std::vector<const FlatShape*> shapes_;  ///< Near to far.
};

}  // namespace defray
