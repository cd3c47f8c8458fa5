#pragma once
// What the gather's twins share: the turn of a pixel's samples.
#include <array>
#include <vector>

#include "methods/gather.h"
#include "reference/pcg3d.h"

namespace defray::reference {

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
