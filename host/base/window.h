#pragma once
// Rectangles of pixels: data windows and display windows.
#include <string>

#include "defray/frame.h"

namespace defray {

inline bool overlap(const Window& a, const Window& b) {
  return a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height;
}

/// What lies in both; without pixels where nothing does.
Window intersection(const Window& a, const Window& b);

/// Both, and what lies between them.
Window hull(const Window& a, const Window& b);

/// "1280x720+0+0".
std::string to_string(const Window& window);

}  // namespace defray
