#include "base/window.h"

#include <fmt/format.h>

namespace defray {

std::string to_string(const Window& w) {
  return fmt::format("{}x{}{:+}{:+}", w.width, w.height, w.x, w.y);
}

}  // namespace defray
