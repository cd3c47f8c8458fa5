#pragma once
// Silhouettes that go on behind what hides them.
#include "frame/frame.h"

namespace defray {

/// What hidden surfaces are made from, beside the picture.
struct Silhouettes {
  /// What `fill` is told: pixels are DEFRAY_MIXED, those of thin surfaces too, and a
  /// DEFRAY_SILHOUETTE goes on behind them.
  Words marks;
  /// Where thin surfaces go on (chain/silhouettes/strips.h).
  Words strips;
};

/// Rows above and below those wanted that `continue_silhouettes` looks at.
int silhouette_rows();

/// Those of the wanted rows of a frame. Where the edge between two surfaces ends at a third one in
/// front of both, it goes on behind that one in its direction: what lies beyond it does not lie on
/// this side of it. ("Good continuation" of image inpainting; Kellman and Shipley 1991 for the
/// shapes that people expect.) `into` gets the rows.
void continue_silhouettes(const Frame& front, const Words& mixed, Silhouettes& into);

}  // namespace defray
