#pragma once
// Random numbers that depend on a place and a seed, not on an order.
#include <cstdint>

namespace defray {

/// A small counter-based generator (splitmix64, Steele et al. 2014).
class Random {
 public:
  Random(int x, int y, std::uint64_t seed)
      : state_((seed * 0xd1342543de82ef95u) ^ (static_cast<std::uint64_t>(y) << 20) ^
               static_cast<std::uint64_t>(x)) {}
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
