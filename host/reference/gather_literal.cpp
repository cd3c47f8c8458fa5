// Twin of kernels/methods/gather_literal.cl: Glatzel & Wilhelm, eq. 4.
#include <cmath>

#include "reference/gather_samples.h"
#include "reference/reference.h"

namespace defray::reference {
namespace {

/// Between four pixels; the frame repeats those of its edges.
float bilinear(const Frame& frame, const Plane& plane, int x, int y, float part_x, float part_y) {
  const auto between = [](float a, float b, float part) { return a + (b - a) * part; };
  const auto in_row = [&](int row) {
    return between(plane[frame.index_within(x, row)], plane[frame.index_within(x + 1, row)],
                   part_x);
  };
  return between(in_row(y), in_row(y + 1), part_y);
}

float literal_pixel(const Frame& frame, const Plane& plane, int x, int y, float radius,
                    const std::vector<std::array<float, 2>>& samples) {
  const float own = plane[frame.index(x, y)];
  if (radius == 0) return own;
  float sum = 0;
  for (const auto& [u, v] : samples) {
    const float dx = radius * u, dy = radius * v;
    const float fx = std::floor(dx), fy = std::floor(dy);
    sum += bilinear(frame, plane, x + static_cast<int>(fx), y + static_cast<int>(fy), dx - fx,
                    dy - fy) -
           own;
  }
  return own + sum / static_cast<float>(samples.size());
}

}  // namespace

std::vector<Plane> gather_literal(const DefrayGatherParams& p, const GatherSamples& samples,
                                  const std::vector<Plane>& channels, const Frame& f) {
  const auto coc_quanta = f.coc_quanta.host();
  const float quantum = std::ldexp(1.0f, -DEFRAY_COC_FRACTION_BITS) * p.radius_scale;
  std::vector<Plane> out(channels);
  for (int y = 0; y < f.height; ++y) {
    for (int x = 0; x < f.width; ++x) {
      const auto turned = samples_of_pixel(p, samples, x, y);
      const std::size_t at = f.index(x, y);
      const float radius = std::fabs(static_cast<float>(coc_quanta[at])) * quantum;
      for (std::size_t c = 0; c < out.size(); ++c) {
        out[c][at] = literal_pixel(f, channels[c], x, y, radius, turned);
      }
    }
  }
  return out;
}

}  // namespace defray::reference
