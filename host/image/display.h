#pragma once
// A window on the screen, and the picture sheets that people look at. OpenCV only.
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

/// Shows a picture until a key is pressed or the window is closed.
void show(const std::string& title, const std::vector<Plane>& planes, int width, int height);

}  // namespace defray
