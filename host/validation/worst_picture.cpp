#include "validation/worst_picture.h"

#include <algorithm>
#include <cmath>

namespace defray::validation {
namespace {

/// A plane for the eye: its finite values from 0 to 1.
Plane stretched(const Plane& plane) {
  float low = 0, high = 0;
  for (const float v : plane) {
    if (!std::isfinite(v)) continue;
    low = std::min(low, v);
    high = std::max(high, v);
  }
  Plane out;
  for (const float v : plane) out.push_back(high > low ? v / (high - low) - low / (high - low) : 0);
  return out;
}

/// Each pixel as a square of `scale` pixels a side, white to the right of them up to `padded_px`.
Plane enlarged(const Plane& plane, int width, int scale, int padded_px) {
  const auto w = static_cast<std::size_t>(width), s = static_cast<std::size_t>(scale);
  const auto padded = static_cast<std::size_t>(padded_px);
  Plane out(plane.size() / w * s * padded, 1.0f);
  for (std::size_t i = 0; i < out.size(); ++i) {
    const std::size_t x = i % padded / s, y = i / padded / s;
    if (x < w) out[i] = plane[y * w + x];
  }
  return out;
}

/// The picture's worth of values that holds the value `at`; empty where they are no picture
/// (tiles).
template <typename T>
Plane picture_of(const std::vector<T>& values, std::size_t at, std::size_t pixels) {
  const std::size_t first = at / pixels * pixels;
  if (first + pixels > values.size()) return {};
  const auto begin = values.begin() + static_cast<std::ptrdiff_t>(first);
  return {begin, begin + static_cast<std::ptrdiff_t>(pixels)};
}

/// The same among whole numbers, as floats, and planes after them.
Plane plane_of(const Outcome& values, std::size_t at, std::size_t pixels) {
  if (at < values.integers.size()) return picture_of(values.integers, at, pixels);
  at -= values.integers.size();
  for (const Plane& plane : values.planes) {
    if (at < plane.size()) return picture_of(plane, at, pixels);
    at -= plane.size();
  }
  return {};
}

}  // namespace

std::optional<WorstPicture> worst_picture(const Case& c, const Run& run, std::size_t at) {
  const std::size_t pixels = static_cast<std::size_t>(c.width) * static_cast<std::size_t>(c.height);
  const Plane kernel = plane_of(run.kernel, at, pixels), twin = plane_of(run.twin, at, pixels);
  if (kernel.empty()) return {};
  Plane difference;
  for (std::size_t i = 0; i < pixels; ++i) difference.push_back(std::fabs(kernel[i] - twin[i]));
  const int scale = std::max(1, 240 / std::max(c.width, c.height));
  constexpr int caption_px = 110;
  WorstPicture picture{
      "", to_string(c), std::max(c.width * scale, caption_px), c.height * scale, {}};
  const auto add = [&](const std::string& caption, const Plane& plane) {
    const Plane large = enlarged(stretched(plane), c.width, scale, picture.width);
    picture.panels.push_back({caption, std::vector<Plane>(3, large)});
  };
  add("kernel", kernel);
  add("twin", twin);
  add("difference", difference);
  return picture;
}

}  // namespace defray::validation
