// Twin of kernels/chain/highlights.cl.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "lens/coc.h"
#include "reference/twin_backend.h"

namespace defray::reference {
namespace {

float light_of(const Frame& f, std::size_t at, int light_channels) {
  float most = f.channels[0][at];
  for (int c = 1; c < light_channels; ++c) {
    most = std::fmax(most, f.channels[static_cast<std::size_t>(c)][at]);
  }
  return most;
}

/// Light of the front fragments at 32 points around a disc, those within the frame and seen.
std::vector<float> light_around(const Frame& f, int x, int y, float radius, int light_channels) {
  std::vector<float> light;
  for (int i = 0; i < 32; ++i) {
    const double angle = i % 16 * std::numbers::pi / 8;
    const float distance = std::fmax(radius, 3.0f) * (i < 16 ? 0.5f : 1.0f) + 2.0f;
    const auto rounded = [&](double direction) {
      return static_cast<int>(std::rint(distance * static_cast<float>(direction)));
    };
    const int qx = x + rounded(std::cos(angle)), qy = y + rounded(std::sin(angle));
    if (qx < 0 || qy < 0 || qx >= f.width || qy >= f.height) continue;
    const std::size_t front = f.index(qx, qy, 0);
    if (f.coverage[front] >= DEFRAY_SYNTHESISED) continue;
    light.push_back(light_of(f, front, light_channels));
  }
  return light;
}

/// The share of its light that a highlight before such surroundings keeps.
float kept_of(float own, float median) {
  constexpr float range = DEFRAY_HIGHLIGHT_WHOLE - DEFRAY_HIGHLIGHT;
  const float of_whole = median / own;
  if (median * DEFRAY_HIGHLIGHT_WHOLE <= own) return of_whole;
  return 1 - (own - DEFRAY_HIGHLIGHT * median) / (range * median) * (1 - of_whole);
}

}  // namespace

Values<float> TwinBackend::highlights(const Frame& f, int light_channels, Values<float>) {
  Plane kept(f.depth.size(), 1.0f);
  for (std::size_t i = 0; i < kept.size(); ++i) {
    const int x = static_cast<int>(i % static_cast<std::size_t>(f.width));
    const int y = static_cast<int>(i / static_cast<std::size_t>(f.width * f.layers));
    const float own = light_of(f, i, light_channels);
    const std::int32_t coc = tame(f.coc_quanta[i]);
    if (f.coverage[i] == 0 || f.coverage[i] >= DEFRAY_SYNTHESISED || coc == 0) continue;
    if (!(own > 0) || std::isinf(own)) continue;
    const float radius = std::fabs(static_cast<float>(coc)) * px_per_quantum;
    std::vector<float> light = light_around(f, x, y, radius, light_channels);
    const auto dim = std::count_if(light.begin(), light.end(),
                                   [&](float v) { return v * DEFRAY_HIGHLIGHT < own; });
    if (static_cast<std::size_t>(dim) <= light.size() / 2) continue;
    // NaNs are no surroundings: the kernel's ranks leave the median to the first that has it.
    float median = 1;
    bool is_found = false;
    for (std::size_t k = 0; k < light.size(); ++k) {
      std::size_t rank = 0;
      for (std::size_t j = 0; j < light.size(); ++j) {
        rank += light[j] < light[k] || (light[j] == light[k] && j < k);
      }
      if (rank == light.size() / 2) {
        median = light[k];
        is_found = true;
      }
    }
    if (is_found) kept[i] = kept_of(own, std::fmax(median, 0.0f));
  }
  return kept;
}

}  // namespace defray::reference
