#pragma once
// pcg3d (Jarzynski & Olano, "Hash functions for GPU rendering", 2020): a hash of three words.
#include <array>
#include <cstdint>

namespace defray::reference {

inline std::array<std::uint32_t, 3> pcg3d(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
  std::array<std::uint32_t, 3> v{x, y, z};
  for (std::uint32_t& word : v) word = word * 1664525u + 1013904223u;
  const auto mix = [&] {
    v[0] += v[1] * v[2];
    v[1] += v[2] * v[0];
    v[2] += v[0] * v[1];
  };
  mix();
  for (std::uint32_t& word : v) word ^= word >> 16;
  mix();
  return v;
}

}  // namespace defray::reference
