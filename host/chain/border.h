#pragma once
// What is taken to be outside the frame: a margin around it.
#include <cstdint>
#include <vector>

#include "chain/defocus.h"
#include "chain/stages.h"
#include "methods/method.h"

namespace defray {

/// A frame with a margin, all planes [height][width] of the whole.
struct ExtendedFrame {
  int width, height, margin;
  std::vector<std::int32_t> coc_quanta;  ///< Signed radius, 1/256 px.
  Plane inverse;                         ///< 1/depth; 0: background.
  std::vector<Plane> channels;
  /// The frame's pixel whose data each has; empty if nobody asks.
  std::vector<std::uint32_t> data;

  FrameView view() const { return {width, height, coc_quanta, inverse, channels}; }
  bool is_in_margin(std::size_t pixel) const;
};

/// The frame's edge pixels repeated around it, for Border::black without their light, as far as
/// rays can come in: the largest CoC on the edge, at most half the frame. `report` gets how far.
ExtendedFrame extend(const PinholeFrame& frame, Border border, bool wants_data,
                     DefocusReport& report);

/// Front fragments of a margin made by Border::clamp: at distance d each has the mean colour of the
/// d pixels inside that begin at the edge and are of its surface. The edge's own colour says ever
/// less the farther out; repeated, what happens to be on it made streaks. Not finite: as it was.
void continue_colours(const ExtendedFrame& frame, Fragments& fragments);

/// The frame's part of a plane.
template <typename T>
std::vector<T> cropped(const std::vector<T>& plane, const ExtendedFrame& e) {
  std::vector<T> out;
  for (int y = e.margin; y < e.height - e.margin; ++y) {
    const auto row = plane.begin() + static_cast<std::ptrdiff_t>(y) * e.width;
    out.insert(out.end(), row + e.margin, row + e.width - e.margin);
  }
  return out;
}

}  // namespace defray
