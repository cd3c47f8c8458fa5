// Twin of kernels/chain/light_maps.cl.
#include <cmath>

#include "lens/coc.h"
#include "reference/reference.h"

namespace defray::reference {
namespace {

float px(std::int32_t quanta) { return static_cast<float>(quanta) * px_per_quantum; }

int nearest(float place) { return static_cast<int>(std::nearbyint(place)); }

/// A source of light and the frame that it is in.
class Traced {
 public:
  Traced(const Frame& f, const std::array<std::int32_t, 4>& where, std::int32_t least)
      : f_(f),
        coc_(px(where[2])),
        x_(static_cast<float>(where[0]) +
           0.5f * static_cast<float>(where[3] % DEFRAY_LIGHT_ROW - 1)),
        y_(static_cast<float>(where[1]) +
           0.5f * static_cast<float>(where[3] / DEFRAY_LIGHT_ROW - 1)),
        least_(px(least)) {}

  /// What is left of the light that passes the lens at (u, v), in its radii.
  float seen_from(float u, float v) const {
    const float longer = std::fmax(std::fabs(u), std::fabs(v));
    const float step_x = u / longer, step_y = v / longer, passed = 1 / longer;
    const int steps = static_cast<int>((coc_ - least_) * longer) + 1;
    float seen = 1, behind_before = 1, met_before = coc_;
    for (int i = 1; i <= steps && seen > 0; ++i) {
      const int x = nearest(x_ + static_cast<float>(i) * step_x);
      const int y = nearest(y_ + static_cast<float>(i) * step_y);
      if (x < 0 || y < 0 || x >= f_.width || y >= f_.height) break;
      const std::size_t at = f_.index(x, y, 0);
      const float met = px(tame(f_.coc_quanta[at]));
      const float behind = met - (coc_ - static_cast<float>(i) * passed);
      const bool is_here = std::fabs(behind) <= passed / 2;
      const bool is_between = behind_before < 0 && behind > 0 &&
                              std::fabs(met - met_before) < 2 * px(DEFRAY_JUMP_QUANTA);
      const bool is_in_front = met < coc_ - px(DEFRAY_JUMP_QUANTA);
      if ((is_here || is_between) && is_in_front && std::fabs(met) >= px(DEFRAY_SHARP_QUANTA)) {
        seen *= 1 - share_of(at);
      }
      behind_before = behind;
      met_before = met;
    }
    return seen;
  }

 private:
  float share_of(std::size_t at) const {
    if (f_.coverage.empty()) return 1;
    return static_cast<float>(f_.coverage[at] & ~DEFRAY_SYNTHESISED) * (1.0f / DEFRAY_WHOLE);
  }

  const Frame& f_;
  float coc_, x_, y_, least_;
};

}  // namespace

std::vector<std::uint8_t> light_maps(const LightSources& lights, const Frame& f) {
  std::vector<std::uint8_t> maps;
  for (std::size_t s = 0; s < lights.where.size(); ++s) {
    const Traced source(f, lights.where[s], lights.maps[s][2]);
    const int side = lights.maps[s][1];
    const auto middle = [&](int i) {
      return static_cast<float>(2 * i + 1 - side) / static_cast<float>(side);
    };
    const float rim = 1 + 4 / static_cast<float>(side);
    for (int j = 0; j < side; ++j) {
      for (int i = 0; i < side; ++i) {
        const float u = middle(i), v = middle(j);
        const float away = std::sqrt(u * u + v * v), inside = std::fmax(away, 1.0f);
        const float seen = away > rim ? 1 : source.seen_from(u / inside, v / inside);
        maps.push_back(static_cast<std::uint8_t>(seen * 255 + 0.5f));
      }
    }
  }
  return maps;
}

}  // namespace defray::reference
