#include "library/transparent.h"

#include <algorithm>

namespace defray {
namespace {

using Spans = std::vector<std::span<const float>>;

bool shines(const Spans& light, std::span<const float> alpha, std::size_t i) {
  return alpha[i] == 0 &&
         std::any_of(light.begin(), light.end(), [i](const auto& plane) { return plane[i] != 0; });
}

}  // namespace

void clear_transparent(const Planes& before, std::span<const float> alpha_before,
                       std::vector<Plane>& after, const Plane& alpha_after) {
  Spans light;
  for (const Values<float>& plane : before) light.push_back(plane.host());
  for (std::size_t i = 0; i < alpha_before.size(); ++i) {
    if (shines(light, alpha_before, i)) return;
  }
  const Spans result(after.begin(), after.end());
  for (std::size_t i = 0; i < alpha_after.size(); ++i) {
    if (!shines(result, alpha_after, i)) continue;
    for (Plane& plane : after) plane[i] = 0;
  }
}

void clear_transparent(const Frame& before, std::vector<Plane>& after) {
  if (!before.has_alpha) return;
  clear_transparent(before.channels, before.channels.back().host(), after, after.back());
}

}  // namespace defray
