#pragma once
// Signs of error: what of each block's look its error grows with.
#include <array>
#include <vector>

#include "prediction/blocks.h"

namespace defray {

/// In the order of the model's weights (error_model.cpp).
inline constexpr std::size_t sign_count = 16;
using SignValues = std::array<float, sign_count>;

/// Rows of blocks beyond which nothing is looked at, in either direction; whole windows begin here.
inline constexpr int sign_reach = 32;

/// The signs of the blocks in `rows` of what there is. `channels` of light there are, at most 3.
std::vector<SignValues> signs_of(const PixelBlocks& blocks, std::size_t channels, Rows rows);

}  // namespace defray
