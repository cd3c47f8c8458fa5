#include "library/grow_window.h"

#include <algorithm>
#include <cmath>

#include "lens/lens.h"

namespace defray {
namespace {

/// |CoC radius|, px, of this depth; 0 where it is kept sharp.
class Blur {
 public:
  Blur(const Lens& lens, int lens_width) : begin_(lens), end_(lens), width_(lens_width) {
    if (lens.focus_end_units > 0) end_.focus_distance_units = lens.focus_end_units;
  }
  double at(double z) const {
    const double radius = std::fabs(std::min(coc(begin_, z), 0.0) + std::max(coc(end_, z), 0.0));
    return begin_.max_coc_px > 0 ? std::min(radius, begin_.max_coc_px) : radius;
  }

 private:
  double coc(const Lens& lens, double z) const {
    if (std::isinf(lens.focus_distance_units)) return -infinite_focus_scale(lens, width_) / z;
    const double background = background_coc_px(lens, width_);
    return std::isinf(z) ? background : background * (z - lens.focus_distance_units) / z;
  }
  Lens begin_, end_;
  int width_;
};

bool is_wanted(const Plane* alpha, std::optional<Grow> grow) {
  if (grow) return *grow != Grow::none;
  return alpha && std::any_of(alpha->begin(), alpha->end(), [](float a) { return a < 1; });
}

/// Whether the disc around a pixel does, as far as windows grow by it.
bool reaches(const Window& window, int x, int y, double radius) {
  const int across = std::max({window.x - x, x - (window.x + window.width - 1), 0});
  const int down = std::max({window.y - y, y - (window.y + window.height - 1), 0});
  return std::hypot(across, down) < radius + 1;
}

}  // namespace

Window grown_window(const Window& data, const Window& display, const Plane* alpha,
                    const Plane& depth, const Lens& lens, int lens_width,
                    std::optional<Grow> grow) {
  if (!is_wanted(alpha, grow)) return data;
  if (grow != Grow::full && hull(data, display) == data) return data;  // it holds all that is seen
  const Blur blur(lens, lens_width);
  // Light that has left the frame and its own size around it is seen by no one.
  const double farthest = std::max(display.width, display.height);
  const bool is_outside = grow != Grow::full && !overlap(data, display);
  double left = 0, right = 0, up = 0, down = 0;
  std::size_t i = 0;
  for (int y = 0; y < data.height; ++y) {
    for (int x = 0; x < data.width; ++x, ++i) {
      if (alpha && (*alpha)[i] == 0) continue;
      const double radius = std::min(blur.at(static_cast<double>(depth[i])), farthest);
      if (is_outside && !reaches(display, data.x + x, data.y + y, radius)) continue;
      left = std::max(left, radius - x);
      right = std::max(right, radius - (data.width - 1 - x));
      up = std::max(up, radius - y);
      down = std::max(down, radius - (data.height - 1 - y));
    }
  }
  const auto px = [](double length) { return static_cast<int>(std::ceil(length)); };
  const Window reached{data.x - px(left), data.y - px(up), data.width + px(left) + px(right),
                       data.height + px(up) + px(down)};
  if (grow == Grow::full) return reached;
  if (!overlap(reached, display)) return data;
  return hull(data, intersection(reached, display));
}

Plane enlarged(const Plane& plane, const Window& from, const Window& to, float value) {
  const auto size = [](int pixels) { return static_cast<std::size_t>(pixels); };
  Plane out(size(to.width) * size(to.height), value);
  for (int y = 0; y < from.height; ++y) {
    std::copy_n(plane.begin() + static_cast<std::ptrdiff_t>(size(y) * size(from.width)), from.width,
                out.begin() + static_cast<std::ptrdiff_t>(size(y + from.y - to.y) * size(to.width) +
                                                          size(from.x - to.x)));
  }
  return out;
}

}  // namespace defray
