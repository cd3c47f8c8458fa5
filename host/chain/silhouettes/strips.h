#pragma once
// Thin surfaces that go on behind what hides them: strips, blades of grass, wires.
#include <span>

#include "chain/silhouettes/ends.h"

namespace defray {

/// So close the two edges of a strip end, one after the other where they are hidden aslant.
inline constexpr int strip_pair_px = 3 * thin_px;

/// Marks the pixels of thin surfaces as DEFRAY_MIXED: `fill` finds nothing on them, which it would
/// smear. Those of the wanted rows.
void mark_thin(const Frame& front, const Words& mixed, std::span<std::uint32_t> marks);

/// Where thin surfaces go on: for each pixel of the wanted rows one of the picture whose surface
/// lies behind it, 1 + its index, or 0. Of two that cross, the nearer.
void continue_strips(const Frame& front, const std::vector<SilhouetteEnd>& ends,
                     std::span<std::uint32_t> strips);

/// Puts what `continue_strips` has found behind the wanted rows.
void paint_strips(const Frame& front, const Words& strips, Frame& behind);

}  // namespace defray
