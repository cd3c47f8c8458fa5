#pragma once
// What the gather's twins share: a frame without end, and the turn of a pixel's samples.
#include <algorithm>
#include <array>
#include <vector>

#include "base/plane.h"
#include "methods/gather.h"
#include "reference/pcg3d.h"

namespace defray::reference {

/// A frame that repeats its edge pixels.
struct GatherFrame {
  int width, height;
  const std::vector<Plane>& channels;

  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(std::clamp(y, 0, height - 1)) *
               static_cast<std::size_t>(width) +
           static_cast<std::size_t>(std::clamp(x, 0, width - 1));
  }
  float bilinear(std::size_t c, int x, int y, float part_x, float part_y) const {
    const Plane& plane = channels[c];
    const auto between = [](float a, float b, float part) { return a + (b - a) * part; };
    const float upper = between(plane[index(x, y)], plane[index(x + 1, y)], part_x);
    const float lower = between(plane[index(x, y + 1)], plane[index(x + 1, y + 1)], part_x);
    return between(upper, lower, part_y);
  }
};

/// A pixel's samples, turned.
inline std::vector<std::array<float, 2>> samples_of_pixel(const DefrayGatherParams& p,
                                                          const GatherSamples& samples, int x,
                                                          int y) {
  if (!p.rotates) return samples.points;
  const auto hash = pcg3d(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), p.seed);
  const auto [c, s] = samples.turns[hash[0] % samples.turns.size()];
  std::vector<std::array<float, 2>> turned;
  for (const auto& [u, v] : samples.points) turned.push_back({u * c - v * s, u * s + v * c});
  return turned;
}

}  // namespace defray::reference
