#pragma once
// Whether there is a screen, and the picture sheets that people look at. OpenCV only.
#include <string>
#include <vector>

#include "base/plane.h"

namespace defray {

/// A picture ready to be shown: linear RGB planes and a caption.
struct SheetPanel {
  std::string caption;
  std::vector<Plane> planes;  ///< R G B, any more are ignored.
};

/// Writes panels of one size side by side, sRGB-encoded, each under its caption, to a PNG or JPEG.
void write_sheet(const std::string& path, const std::vector<SheetPanel>& panels, int width,
                 int height);

/// Whether a window can be opened; if not, `why` says what is missing.
bool has_display(std::string& why);

}  // namespace defray
