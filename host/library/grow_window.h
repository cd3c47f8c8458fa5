#pragma once
// A data window that ends at its objects, as compositors' bounding boxes do, holds no room for
// their blur.
#include <optional>

#include "base/plane.h"
#include "base/window.h"
#include "defray/io.h"

namespace defray {

/// What blurred light of the window's pixels reaches, as far as `grow` lets it; the window itself
/// where nothing is to be done. `alpha`: none where the picture has none. Depth is planar.
Window grown_window(const Window& data, const Window& display, const Plane* alpha,
                    const Plane& depth, const Lens& lens, int lens_width, std::optional<Grow> grow);

/// A plane of `from`, in `to`, which holds it, with `value` around.
Plane enlarged(const Plane& plane, const Window& from, const Window& to, float value);

}  // namespace defray
