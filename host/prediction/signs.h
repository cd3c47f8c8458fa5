#pragma once
// Signs of error: what of each block's look its error grows with.
#include <array>
#include <vector>

#include "prediction/blocks.h"

namespace defray {

/// In the order of the model's weights (error_model.cpp).
inline constexpr std::size_t sign_count = 15;
using SignValues = std::array<float, sign_count>;

/// How the picture was made, as far as signs depend on it.
struct Making {
  int lens_points = 0;
  bool has_patterns = true, is_half_size = false;
};

/// The signs of every block, in their order.
/// `channels` of light there are, at most 3.
std::vector<SignValues> signs_of(const PixelBlocks& blocks, std::size_t channels,
                                 const Making& making);

}  // namespace defray
