#pragma once
// How well pixels agree, as the searches for shifts count it. Integers: exact, in any order.
#include <cstddef>
#include <cstdint>
#include <limits>

#include "kernels/patterns_params.h"

namespace defray {

/// Of 8-bit colours, all three together.
inline std::uint32_t squared_difference(std::uint32_t a, std::uint32_t b) {
  int sum = 0;
  for (const int bit : {0, 8, 16}) {
    const int d = static_cast<int>(a >> bit & 255) - static_cast<int>(b >> bit & 255);
    sum += d * d;
  }
  return static_cast<std::uint32_t>(sum);
}

/// Of a shift that too few pixels can use.
inline constexpr std::uint64_t no_shift_cost = std::numeric_limits<std::uint64_t>::max();

/// The mean squared difference in 1/256, and what rounding to 8 bits hides of it (2/3) over the
/// share of `all` pixels that have a partner: of shifts that agree as well as can be seen, the
/// one that more pixels can use is the better. `no_shift_cost` with fewer pairs than `least`.
inline std::uint64_t shift_cost(const DefrayAgreement& sum, std::uint64_t all,
                                std::uint64_t least) {
  constexpr std::uint64_t hidden = 2 * 256 / 3;
  return sum.pairs == 0 || sum.pairs < least
             ? no_shift_cost
             : (sum.squares << 8) / sum.pairs + hidden * all / sum.pairs;
}

}  // namespace defray
