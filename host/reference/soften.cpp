// Twin of kernels/chain/soften.cl.
#include <cstdlib>

#include "lens/lens_grid.h"
#include "reference/stage_frame.h"

namespace defray::reference {
namespace {

/// The square of picture that one lens point sees, as samples: `stride` apart, `taps` to each side.
struct Square {
  float half_side;  ///< In pixels.
  int stride, taps;

  explicit Square(float side) : half_side(0.5f * side) {
    const int reach = static_cast<int>(half_side + 0.5f), side_px = 2 * reach + 1;
    stride = (side_px + DEFRAY_SOFTEN_TAPS - 1) / DEFRAY_SOFTEN_TAPS;
    taps = reach / stride;  // at most half of DEFRAY_SOFTEN_TAPS
  }
  /// How much of a pixel this far along x or y lies inside.
  float inside(int offset) const {
    return std::clamp(half_side + 0.5f - static_cast<float>(std::abs(offset)), 0.0f, 1.0f);
  }
};

std::uint32_t share_of(const Frame& f, std::size_t i) {
  return f.coverage.empty() ? DEFRAY_WHOLE : f.coverage[i] & ~DEFRAY_SYNTHESISED;
}

/// Mean difference of the fragments around to the fragment at (x, y), weighed.
Colour mean_difference(const Frame& f, int x, int y, int layer, float side) {
  const std::size_t own_at = f.index(x, y, layer);
  const Colour own = colour_at(f.channels, own_at);
  const auto own_coc = static_cast<float>(f.coc_quanta[own_at]);
  const Square square(side);
  Colour sum{};
  float weights = 0;
  for (int j = -square.taps; j <= square.taps; ++j) {
    for (int i = -square.taps; i <= square.taps; ++i) {
      const int dx = square.stride * i, dy = square.stride * j;
      if (x + dx < 0 || y + dy < 0 || x + dx >= f.width || y + dy >= f.height) continue;
      const std::size_t q = f.index(x + dx, y + dy, layer);
      const auto coc = static_cast<float>(f.coc_quanta[q]);
      if (std::fabs(coc - own_coc) > 128 * side) continue;  // half a cell
      const float weight = square.inside(dx) * square.inside(dy) *
                           std::ldexp(static_cast<float>(share_of(f, q)), -16);
      if (weight == 0) continue;
      Colour difference = colour_at(f.channels, q);
      for (std::size_t c = 0; c < 4; ++c) difference[c] -= own[c];
      add(sum, weight, difference);
      weights += weight;
    }
  }
  return divided(sum, weights);
}

}  // namespace

Planes TwinBackend::soften(const Frame& f, int samples, Planes) {
  std::vector<Plane> out = planes_of(f.channels);
  for (int y = 0; y < f.height; ++y) {
    for (int layer = 0; layer < f.layers; ++layer) {
      for (int x = 0; x < f.width; ++x) {
        const std::size_t at = f.index(x, y, layer);
        const float side = std::fabs(static_cast<float>(f.coc_quanta[at])) * (2.0f / 256) /
                           cells_per_side(samples);
        if (side <= 1 || share_of(f, at) == 0) continue;
        const Colour mean = mean_difference(f, x, y, layer, side);
        for (std::size_t c = 0; c < out.size(); ++c) {
          float& own = out[c][at];
          if (mean[c] != 0 && std::isfinite(own)) own += mean[c];  // -0 stays -0
        }
      }
    }
  }
  return out;
}

}  // namespace defray::reference
