#pragma once
// Rectangles of pixels: data windows and display windows.
#include <cstdint>
#include <string>

#include "defray/frame.h"

namespace defray {

inline bool overlap(const Window& a, const Window& b) {
  return a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height;
}

/// What kernels count with 32 bits in, a margin and hidden surfaces included: 16384 x 16384.
constexpr int max_side = 1 << 16;
constexpr std::int64_t max_pixels = std::int64_t{1} << 28;

constexpr bool has_allowed_size(int width, int height) {
  return width >= 1 && height >= 1 && width <= max_side && height <= max_side &&
         std::int64_t{width} * height <= max_pixels;
}

/// Throws Error(input), "WHAT has 70000x70000 pixels: allowed are ...".
void require_allowed_size(const std::string& what, int width, int height);

/// What lies in both; without pixels where nothing does.
Window intersection(const Window& a, const Window& b);

/// Both, and what lies between them.
Window hull(const Window& a, const Window& b);

/// "1280x720+0+0".
std::string to_string(const Window& window);

}  // namespace defray
