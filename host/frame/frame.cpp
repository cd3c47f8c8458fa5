#include "frame/frame.h"

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <utility>

#include "kernels/params.h"

namespace defray {

Planes Planes::view(const std::vector<Plane>& planes) {
  Planes views;
  for (const Plane& plane : planes) {
    views.push_back(Values<float>::view(plane.data(), plane.size()));
  }
  return views;
}

std::vector<Plane> taken(Planes planes) {
  std::vector<Plane> all;
  for (Values<float>& plane : planes) all.push_back(std::move(plane).take());
  return all;
}

void CocRange::add(const CocRange& other) {
  least = std::min(least, other.least);
  largest = std::max(largest, other.largest);
}

std::int32_t CocRange::largest_radius() const {
  return std::max(std::abs(least), std::abs(largest));
}

CocRange Frame::coc_range() const {
  if (known_range) return *known_range;
  const auto coc = coc_quanta.host();
  CocRange range{coc.front(), coc.front()};
  for (const std::int32_t quanta : coc) {  // a quarter of std::ranges::minmax's time
    range.least = quanta < range.least ? quanta : range.least;
    range.largest = quanta > range.largest ? quanta : range.largest;
  }
  return range;
}

bool Frame::is_in_margin(std::size_t pixel) const {
  return is_in_margin(static_cast<int>(pixel % size(width)), static_cast<int>(pixel / size(width)));
}

std::uint32_t Frame::data_pixel(std::size_t surface) const {
  if (!data_of.empty()) return data_of[surface];
  const std::size_t row = surface / size(width) / size(layers);
  return static_cast<std::uint32_t>(row * size(width) + surface % size(width));
}

Frame Frame::without_planes() const {
  Frame f;
  f.width = width;
  f.height = height;
  f.has_alpha = has_alpha;
  f.origin_x = origin_x;
  f.origin_y = origin_y;
  f.display_width = display_width;
  f.display_height = display_height;
  f.margin = margin;
  f.layers = layers;
  return f;
}

float no_fragment() { return std::bit_cast<float>(DEFRAY_EMPTY); }

bool is_fragment(float depth) { return std::bit_cast<std::uint32_t>(depth) != DEFRAY_EMPTY; }

}  // namespace defray
