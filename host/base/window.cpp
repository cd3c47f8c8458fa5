#include "base/window.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.h"

namespace defray {

void require_allowed_size(const std::string& what, int width, int height) {
  if (has_allowed_size(width, height)) return;
  fail(ErrorKind::input, "{} has {}x{} pixels; allowed are 1 to {} a side and {} in all", what,
       width, height, max_side, max_pixels);
}

Window intersection(const Window& a, const Window& b) {
  const int x = std::max(a.x, b.x), y = std::max(a.y, b.y);
  return {x, y, std::min(a.x + a.width, b.x + b.width) - x,
          std::min(a.y + a.height, b.y + b.height) - y};
}

Window hull(const Window& a, const Window& b) {
  const int x = std::min(a.x, b.x), y = std::min(a.y, b.y);
  return {x, y, std::max(a.x + a.width, b.x + b.width) - x,
          std::max(a.y + a.height, b.y + b.height) - y};
}

std::string to_string(const Window& w) {
  return fmt::format("{}x{}{:+}{:+}", w.width, w.height, w.x, w.y);
}

}  // namespace defray
