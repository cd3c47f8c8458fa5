#pragma once
// Frames at half the size.
#include <cstdint>
#include <vector>

#include "frame/frame.h"
#include "kernels/params.h"

namespace defray {

/// The CoC at half the size. Means of 2x2 and lines between them blur by themselves: 1/4 and 3/4
/// px^2 of variance, as much as a disc of 2 px (variance r^2 / 4), which the lens need not add.
std::int32_t half_size_coc(std::int32_t coc_quanta);

/// A disc of this radius leaves nothing of the finest detail.
constexpr float nothing_left_px = 1.75f;

/// The share of a picture's finest detail (periods of 2 to 4 px, which half the size cannot hold)
/// that a disc of this radius lets through: its transfer function 2 J1(x) / x, x = 2 pi radius /
/// period, in the mean over those periods, within 0.04.
float detail_left(std::int32_t coc_quanta);

/// Not nearer than the focus and blurred beyond all detail: through that shows what lies behind,
/// but the pinhole picture has its sharp edges there, which show nowhere.
inline bool is_clear(std::int32_t coc_quanta) {
  constexpr float beyond_detail = -nothing_left_px * (1 << DEFRAY_COC_FRACTION_BITS);
  return coc_quanta > static_cast<std::int32_t>(beyond_detail);
}

/// Blocks of 2x2 pixels as pixels: mean colours, CoC and depth of one of the four, so that they are
/// a surface's own: of a lamp (more light than the others together) or of the lower median by CoC.
/// Of odd sizes the last pixels count twice.
struct HalfFrame {
  Frame frame;  ///< As any other; the rest is only for the way back to full size.
  std::vector<std::uint32_t> source;  ///< The pixel that CoC and depth are of.
  Plane detail;                       ///< Mean share of detail_left.
  /// Share of the pixels whose detail may show, and their part of the mean colours: all but those
  /// that are nearer than the focus and blurred beyond all detail.
  Plane clear;
  std::vector<Plane> clear_colour;
};
HalfFrame at_half_size(const Frame& frame);

}  // namespace defray
