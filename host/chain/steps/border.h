#pragma once
// What is taken to be outside the frame: a margin around it.
#include "defray/options.h"
#include "defray/report.h"
#include "frame/frame.h"

namespace defray {

/// The place of the frame with a margin around it, as wide as rays can come in: the largest CoC on
/// the edge, at most half the frame. No planes. `report` gets how wide.
Frame with_margin(const Frame& frame, Border border, ChainReport& report);

/// The frame's pixel that one of the extended frame repeats.
std::size_t picture_pixel(const Frame& extended, int x, int y);

/// 1/depth; of background 0.
float inverse_of(float depth);

/// Rows of `extended`'s CoC, the edge's repeated in its margin; and of its other planes: colours,
/// of Border::black without light in the margin, `inverse` instead of depth, and data_of if
/// `wants_data`.
void repeat_coc(const Frame& frame, const Frame& extended, Rows rows, Quanta& coc);
void repeat_surfaces(const Frame& frame, Border border, bool wants_data, Rows rows,
                     Frame& extended);

/// Front surfaces of a margin made by Border::clamp: at distance d each has the mean colour of the
/// d pixels inside that begin at the edge and are of its surface. The edge's own colour says ever
/// less the farther out; repeated, what happens to be on it made streaks. Not finite: as it was. Of
/// the wanted rows; the margin above comes with the first ones, which must be rows_to_continue at
/// least, and the one below with the last, which looks at as many and must hold all of it.
void continue_colours(Frame& frame);
int rows_to_continue(const Frame& frame);

}  // namespace defray
