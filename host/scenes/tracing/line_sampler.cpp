#include "scenes/tracing/line_sampler.h"

#include <algorithm>
#include <numbers>

namespace defray {

/// Rays from lens points (u0 + s du, v) through the picture's points (x0 + s dx, y), s from 0 to
/// `length`.
struct LineSampler::Line {
  double u0, du, v, x0, dx, y, length;
};

std::optional<LineSampler> LineSampler::of(const Scene& scene, const Lens& lens) {
  LineSampler sampler(scene, lens);
  if (scene.background) return std::nullopt;
  for (const auto& primitive : scene.primitives) {
    const auto* shape = dynamic_cast<const FlatShape*>(primitive.get());
    if (!shape) return std::nullopt;
    sampler.shapes_.push_back(shape);
  }
  std::sort(sampler.shapes_.begin(), sampler.shapes_.end(),
            [](const FlatShape* a, const FlatShape* b) { return a->depth() < b->depth(); });
  return sampler;
}

Exposure LineSampler::along(const Line& line) const {
  const Ray begin = tracer_.lens_ray(lens_, line.x0, line.y, {line.u0, line.v});
  const Ray end = tracer_.lens_ray(lens_, line.x0 + line.dx, line.y, {line.u0 + line.du, line.v});
  // Stretches of the line that nothing nearer covers, as their ends.
  std::vector<double> open{0, line.length}, xs, rest;
  Exposure sum;
  for (const FlatShape* shape : shapes_) {
    const double z = shape->depth(), y = begin.origin.y + z * begin.direction.y;
    const double from = begin.origin.x + z * begin.direction.x;
    const double per_s = end.origin.x + z * end.direction.x - from;
    xs.clear();
    shape->add_crossings(y, xs);
    if (per_s < 0) std::reverse(xs.begin(), xs.end());
    for (std::size_t i = 0; i + 1 < xs.size(); i += 2) {
      const double enter = (xs[i] - from) / per_s, leave = (xs[i + 1] - from) / per_s;
      double covered = 0;
      rest.clear();
      for (std::size_t j = 0; j < open.size(); j += 2) {
        const double a = std::clamp(enter, open[j], open[j + 1]);
        const double b = std::clamp(leave, open[j], open[j + 1]);
        covered += b - a;
        if (a > open[j]) rest.insert(rest.end(), {open[j], a});
        if (b < open[j + 1]) rest.insert(rest.end(), {b, open[j + 1]});
      }
      std::swap(open, rest);
      sum.colour = sum.colour + shape->colour() * covered;
      sum.alpha += covered;
    }
  }
  return sum;
}

Exposure LineSampler::pixel(int x, int y, int samples, Random random) const {
  const double shift = random.next();
  const PixelPoints square(0, 0, random);
  Exposure sum;
  double weight_sum = 0;
  for (int i = 0; i < samples; ++i) {
    // Heights v = sin(angle), weighed by the chord's length: for even angles, weights sum exactly.
    const double angle = std::numbers::pi * ((i + shift) / samples - 0.5);
    const double v = std::sin(angle), half = std::cos(angle), weight = half * half;
    const auto [start, row] = square.point(i);
    const double way =
        i % 2 ? 1 : -1;  // or one depth's points would stay in place, line after line
    const double u0 = way * half * (2 * start - 1), du = way * 2 * half;
    // From u0 to the chord's end, then from its beginning to u0.
    const double py = y + row, first = 1 - start;
    const Exposure a = along({u0, du, v, x + 0.0, 1, py, first});
    const Exposure b = along({-way * half, du, v, x + first, 1, py, start});
    sum.colour = sum.colour + (a.colour + b.colour) * weight;
    sum.alpha += (a.alpha + b.alpha) * weight;
    weight_sum += weight;
  }
  return {sum.colour / weight_sum, sum.alpha / weight_sum};
}

}  // namespace defray
