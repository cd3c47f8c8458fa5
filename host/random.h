#pragma once
// Random numbers that depend on a place and a seed, not on an order.
#include <cstdint>

namespace defray {

/// A small counter-based generator (splitmix64, Steele et al. 2014).
class Random {
 public:
  Random(std::uint32_t x, std::uint32_t y, std::uint32_t seed)
      : state_((std::uint64_t{seed} << 40) ^ (std::uint64_t{y} << 20) ^ x) {}
  /// Uniform in [0, 1).
  double next() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
  }

 private:
  std::uint64_t state_;
};

}  // namespace defray
