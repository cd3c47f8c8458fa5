#pragma once
// Silhouettes that go on behind what hides them.
#include "frame/frame.h"

namespace defray {

/// Rows above and below those wanted that `continue_silhouettes` looks at.
int silhouette_rows();

/// What `fill` is told of the wanted rows of a frame: where pixels are DEFRAY_MIXED, and where a
/// DEFRAY_SILHOUETTE goes on. Where the edge between two surfaces ends at a third one in front of
/// both, it goes on behind that one in its direction: what lies beyond it does not lie on this side
/// of it. ("Good continuation" of image inpainting; Kellman and Shipley 1991 for the shapes that
/// people expect.) `into` gets the rows.
Words continue_silhouettes(const Frame& front, const Words& mixed, Words into);

}  // namespace defray
