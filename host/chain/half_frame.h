#pragma once
// Frames and planes at half the size and back: what halving loses, and what of it can come back.
#include <cstdint>
#include <vector>

#include "frame/frame.h"

namespace defray {

/// The CoC at half the size. Means of 2x2 and lines between them blur by themselves: 1/4 and 3/4
/// px^2 of variance, as much as a disc of 2 px (variance r^2 / 4), which the lens need not add.
std::int32_t half_size_coc(std::int32_t coc_quanta);

/// The share of a picture's finest detail (periods of 2 to 4 px, which half the size cannot hold)
/// that a disc of this radius lets through: its transfer function 2 J1(x) / x, x = 2 pi radius /
/// period, in the mean over those periods, within 0.04; none from 1.75 px on.
float detail_left(std::int32_t coc_quanta);

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

/// A plane of ((width + 1) / 2) x ((height + 1) / 2) values at width x height: linear between the
/// middles of blocks.
Plane at_full_size(const Plane& half, int width, int height);

/// `half_result` of a channel at full size, with the detail that the frame has beside the clear
/// pixels of the half frame, by `half_visible` of it; nothing darker than black, and nothing that
/// is not a number.
Plane with_detail(const Frame& frame, const HalfFrame& half, std::size_t channel,
                  const Plane& half_result, const Plane& half_visible);

}  // namespace defray
