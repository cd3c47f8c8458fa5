#pragma once
// How much of the aperture's light falls into a box, exactly and in integers.
#include <cstdint>
#include <vector>

#include "lens/aperture_mask.h"

namespace defray {

/// The mask's summed-area table: entry (row, column) is the sum of the coverage of all texels above
/// and to the left, row by row, (side + 1)^2 entries. At most 255 * 2^18 < 2^26.
///
/// A box's corner in lens coordinates (2^-16 of the aperture radius) is (c + 2^16) in units of
/// 1/256 texel, limited to 0 ... 2^17: bits 8 and up choose the entry, bits 0 to 7 weigh it against
/// the next. Coverage is constant within a texel, so bilinear weights lose nothing: four corners,
/// added and subtracted, give a box's light without error.
struct ApertureTable {
  static constexpr int side = ApertureMask::side + 1;
  std::vector<std::uint32_t> sums;

  /// Light of the whole aperture, in light_in_box's units; above 0.
  std::uint64_t total() const { return std::uint64_t{sums.back()} << 16; }
};

ApertureTable make_aperture_table(const ApertureMask& mask);

/// Light within [u0, u1) x [v0, v1), lens coordinates in 2^-16 of the aperture radius, any of them
/// outside the square too; 0 for an empty box. In units of 2^-16 of a texel's coverage of 1; below
/// 2^42. Boxes that tile the square add up to total(), to the bit.
std::uint64_t light_in_box(const ApertureTable& table, std::int32_t u0, std::int32_t v0,
                           std::int32_t u1, std::int32_t v1);

}  // namespace defray
