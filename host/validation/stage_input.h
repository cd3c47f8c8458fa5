#pragma once
// What kernels are given beside a case's planes: made from these, and from the case's seed.
#include "lens/aperture_table.h"
#include "methods/gather.h"
#include "rdb/rdb.h"
#include "validation/input.h"

namespace defray::validation {

/// The case's frame as stages are meant to see it: patterns without surfaces become blocks of 9 x 6
/// pixels with thin columns between them, two seeds of three slant all surfaces, and depth is
/// 1/depth with the background at 0.
Frame stage_frame(const Case& c, const Input& in);

/// The frame with anti-aliased steps: CoC and depth are means of two or three pixels along a
/// direction, and in two of three blocks of 8 px colours, too.
Frame blurred(const Case& c, Frame frame);

/// What `fill` is told of a frame: mixed pixels, and of two seeds of three silhouettes, of pixels
/// anywhere.
Words marks_of(const Case& c, const Frame& frame);

/// Words that are not 0 at few pixels, or at many: anywhere, or, of one seed of three, nowhere.
Words strips_of(const Case& c);

/// The case's fragments with CoC radii that lie together.
Frame soft_fragments(const Case& c, const Input& in);

/// The case's fragments, every thirteenth far brighter; coverage is always there, and 0 where there
/// is no fragment, as the stages leave it.
Frame bright_fragments(const Input& in);

/// An aperture without symmetry, so that no mirror image passes.
const ApertureTable& lopsided_aperture();

/// What the case's rays go through.
RayPlan ray_plan(const Case& c);

DefrayTiltshiftParams tiltshift_case(const Case& c);
GatherSettings gather_case(GatherKind kind, const Case& c);

}  // namespace defray::validation
