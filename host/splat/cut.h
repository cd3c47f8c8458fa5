#pragma once
// Which nodes of the hierarchy a view is drawn with.
#include "frame/values.h"
#include "kernels/splat_params.h"
#include "splat/hierarchy.h"

namespace defray {

/// The nodes that stand for what the view can show. With `lod` those whose width in the picture is
/// below a pixel, or below their blur, stand for their points (Krivanek & Zara 2003, section 6.2);
/// else every point stands for itself. In the hierarchy's order.
Values<DefraySplatNode> cut_hierarchy(const Hierarchy& tree, const DefraySplatParams& view,
                                      bool lod);

}  // namespace defray
