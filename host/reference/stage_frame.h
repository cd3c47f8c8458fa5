#pragma once
// What the stages' twins share: pixels by place, CoC radii in range, colours of four channels.
#include <algorithm>
#include <array>
#include <cmath>

#include "lens/coc.h"
#include "reference/twin_backend.h"

namespace defray::reference {

struct Place {
  int x, y;
};

inline Place operator+(Place a, Place b) { return {a.x + b.x, a.y + b.y}; }
inline Place operator-(Place a, Place b) { return {a.x - b.x, a.y - b.y}; }
inline Place operator*(int n, Place a) { return {n * a.x, n * a.y}; }

/// The CoC of a frame of one layer, which goes on beyond its edges, by place. Apart from the frame,
/// whose values are looked for, on a device or here, each time that one is asked for.
struct CocFrame {
  explicit CocFrame(const Frame& f) : frame(f), coc_quanta(f.coc_quanta.host()) {}
  const Frame& frame;
  std::span<const std::int32_t> coc_quanta;

  bool contains(Place at) const {
    return at.x >= 0 && at.y >= 0 && at.x < frame.width && at.y < frame.height;
  }
  std::size_t index(Place at) const { return frame.index_within(at.x, at.y); }
  /// Limited to what differences can be taken of.
  std::int32_t coc(std::size_t pixel) const { return tame(coc_quanta[pixel]); }
  std::int32_t coc(Place at) const { return coc(index(at)); }

  template <typename Visit>
  void for_each_place(const Visit& visit) const {
    for (int y = 0; y < frame.height; ++y) {
      for (int x = 0; x < frame.width; ++x) visit(Place{x, y});
    }
  }
};

/// The pixels up to `reach` away in both directions, row by row.
template <typename Visit>
void for_each_around(Place at, int reach, const Visit& visit) {
  for (int y = -reach; y <= reach; ++y) {
    for (int x = -reach; x <= reach; ++x) visit(at + Place{x, y});
  }
}

/// Four channels; a missing one repeats the last.
using Colour = std::array<float, 4>;

inline Colour colour_at(const Planes& channels, std::size_t pixel) {
  Colour colour;
  for (std::size_t c = 0; c < 4; ++c) colour[c] = channels[std::min(c, channels.size() - 1)][pixel];
  return colour;
}

inline void set_colour(std::vector<Plane>& channels, std::size_t pixel, const Colour& colour) {
  for (std::size_t c = 0; c < channels.size(); ++c) channels[c][pixel] = colour[c];
}

/// Copies to work on.
inline std::vector<Plane> planes_of(const Planes& channels) {
  std::vector<Plane> planes;
  for (const Values<float>& channel : channels) planes.emplace_back(channel.begin(), channel.end());
  return planes;
}

template <typename T>
std::vector<T> copy_of(const Values<T>& values) {
  return {values.begin(), values.end()};
}

/// sum += weight * colour
inline void add(Colour& sum, float weight, const Colour& colour) {
  for (std::size_t c = 0; c < 4; ++c) sum[c] += weight * colour[c];
}

inline Colour divided(Colour sum, float weights) {
  for (float& channel : sum) channel /= weights;
  return sum;
}

}  // namespace defray::reference
