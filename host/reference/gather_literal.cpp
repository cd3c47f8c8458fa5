// Twin of kernels/methods/gather_literal.cl: Glatzel & Wilhelm, eq. 4.
#include <cmath>

#include "reference/gather_frame.h"
#include "reference/reference.h"

namespace defray::reference {
namespace {

float literal_pixel(const GatherFrame& frame, std::size_t c, int x, int y, float radius,
                    const std::vector<std::array<float, 2>>& samples) {
  const float own = frame.channels[c][frame.index(x, y)];
  if (radius == 0) return own;
  float sum = 0;
  for (const auto& [u, v] : samples) {
    const float dx = radius * u, dy = radius * v;
    const float fx = std::floor(dx), fy = std::floor(dy);
    sum += frame.bilinear(c, x + static_cast<int>(fx), y + static_cast<int>(fy), dx - fx, dy - fy) -
           own;
  }
  return own + sum / static_cast<float>(samples.size());
}

}  // namespace

std::vector<Plane> gather_literal(const DefrayGatherParams& p, const GatherSamples& samples,
                                  const std::vector<Plane>& channels, const Frame& f) {
  const auto coc_quanta = f.coc_quanta.host();
  const GatherFrame frame{f.width, f.height, channels};
  const float quantum = std::ldexp(1.0f, -DEFRAY_COC_FRACTION_BITS) * p.radius_scale;
  std::vector<Plane> out(channels);
  for (int y = 0; y < frame.height; ++y) {
    for (int x = 0; x < frame.width; ++x) {
      const auto turned = samples_of_pixel(p, samples, x, y);
      const std::size_t at = frame.index(x, y);
      const float radius = std::fabs(static_cast<float>(coc_quanta[at])) * quantum;
      for (std::size_t c = 0; c < out.size(); ++c) {
        out[c][at] = literal_pixel(frame, c, x, y, radius, turned);
      }
    }
  }
  return out;
}

}  // namespace defray::reference
