#include "image/nonfinite.h"

#include <cmath>

#include "base/error.h"

namespace defray {

std::size_t handle_nonfinite(std::vector<Plane>& colour, Nonfinite policy, const Window& data,
                             const std::string& path) {
  std::size_t count = 0;
  for (Plane& plane : colour) {
    for (std::size_t i = 0; i < plane.size(); ++i) {
      if (std::isfinite(plane[i])) continue;
      ++count;
      if (policy == Nonfinite::zero) plane[i] = 0;
      if (policy == Nonfinite::error) {
        const auto width = static_cast<std::size_t>(data.width);
        fail(ErrorKind::input,
             "{}: colour {} at pixel ({}, {}); {} zero replaces such values, keep lets them "
             "through",
             path, plane[i], data.x + static_cast<int>(i % width),
             data.y + static_cast<int>(i / width), field("nonfinite"));
      }
    }
  }
  return count;
}

}  // namespace defray
