#pragma once
// What a frame's pixels are made of: the sources of the ray distribution buffer.
#include <cstdint>
#include <vector>

#include "lens/coc.h"

namespace defray {

/// One or two surfaces a pixel: layer 0 what is in front, layer 1 what lies behind it. All planes
/// are [height][layers][width].
struct Fragments {
  int width = 0, height = 0, layers = 1;
  std::vector<std::int32_t> coc_quanta;  ///< Signed radius, 1/256 px.
  Plane depth;                           ///< > 0; `no_fragment()` where there is none.
  /// Share of the pixel that a fragment covers, in 2^-16, with the flag DEFRAY_SYNTHESISED. Empty:
  /// every fragment is whole, and all were seen.
  std::vector<std::uint32_t> coverage;
  std::vector<Plane> channels;  ///< 1 to 4.
  /// The frame's pixel whose data (ids, normals) a fragment has; DEFRAY_EMPTY: none, it was made
  /// up. Empty: each has its own pixel's.
  std::vector<std::uint32_t> data_of = {};

  std::size_t index(int x, int y, int layer) const {
    return (static_cast<std::size_t>(y) * static_cast<std::size_t>(layers) +
            static_cast<std::size_t>(layer)) *
               static_cast<std::size_t>(width) +
           static_cast<std::size_t>(x);
  }

  /// Index of the front fragment of a pixel, counted row by row.
  std::size_t front_of(std::size_t pixel) const {
    const auto columns = static_cast<std::size_t>(width);
    return pixel / columns * static_cast<std::size_t>(layers) * columns + pixel % columns;
  }
};

/// The same, in someone else's memory, which must stay alive and unchanged.
struct FragmentView {
  int width, height, layers;
  const std::vector<std::int32_t>& coc_quanta;
  const Plane& depth;
  const std::vector<std::uint32_t>* coverage;  ///< Null: all whole and seen.
  const std::vector<Plane>& channels;
  const std::vector<std::uint32_t>* data_of = nullptr;  ///< Null: each its own pixel's.

  FragmentView(int w, int h, const std::vector<std::int32_t>& coc, const Plane& z,
               const std::vector<Plane>& c)
      : width(w), height(h), layers(1), coc_quanta(coc), depth(z), coverage(nullptr), channels(c) {}
  explicit FragmentView(const Fragments& f)
      : width(f.width),
        height(f.height),
        layers(f.layers),
        coc_quanta(f.coc_quanta),
        depth(f.depth),
        coverage(f.coverage.empty() ? nullptr : &f.coverage),
        channels(f.channels),
        data_of(f.data_of.empty() ? nullptr : &f.data_of) {}

  /// The pixel whose data a fragment has.
  std::uint32_t data_pixel(std::size_t fragment) const {
    if (data_of) return (*data_of)[fragment];
    const auto columns = static_cast<std::size_t>(width);
    const std::size_t row = fragment / columns / static_cast<std::size_t>(layers);
    return static_cast<std::uint32_t>(row * columns + fragment % columns);
  }
};

/// The depth of no fragment: its bits are DEFRAY_EMPTY.
float no_fragment();
bool is_fragment(float depth);

}  // namespace defray
