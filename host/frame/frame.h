#pragma once
// The one frame that stages take and give: planes of one size, on the host or on a device.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "base/plane.h"
#include "frame/band_rows.h"
#include "frame/values.h"

namespace defray {

/// Planes of colour, 1 to 4.
class Planes : public std::vector<Values<float>> {
 public:
  using std::vector<Values<float>>::vector;
  Planes(std::vector<Plane> planes) {  // planes in host memory are planes
    for (Plane& plane : planes) emplace_back(std::move(plane));
  }
  /// Somebody else's memory, which must stay alive and unchanged.
  static Planes view(const std::vector<Plane>& planes);
};

/// As vectors; no copies where nobody else has the planes.
std::vector<Plane> taken(Planes planes);

/// For four arguments of one to four channels: a missing one repeats the last.
template <typename Channel>
auto four_channels(std::size_t count, const Channel& channel) {
  std::array<decltype(channel(std::size_t{})), 4> all;
  for (std::size_t c = 0; c < 4; ++c) all[c] = c < count ? channel(c) : all[c - 1];
  return all;
}

/// CoC radii of a frame, quanta.
struct CocRange {
  std::int32_t least, largest;

  /// With other surfaces' radii.
  void add(const CocRange& other);
  /// The largest |radius|.
  std::int32_t largest_radius() const;
};

/// A picture on its way through the lens. Every plane is [height][layers][width]; what a stage does
/// not need may be empty.
struct Frame {
  int width = 0, height = 0;
  Quanta coc_quanta = {};
  Values<float> depth = {};  ///< Planar, > 0, inf: background; `no_fragment()`: nothing there.
  Planes channels = {};      ///< Linear colour, premultiplied.
  bool has_alpha = false;    ///< The last channel is alpha.
  /// Where the frame lies in the display window, and that window's size; 0: the frame itself.
  int origin_x = 0, origin_y = 0, display_width = 0, display_height = 0;
  /// Columns and rows on each side that were added around the picture.
  int margin = 0;
  /// Surfaces a pixel: layer 0 is what is in front, layer 1 what lies behind it.
  int layers = 1;
  Values<float> inverse = {};  ///< 1/depth; 0: background; negative: nothing there.
  /// Share of the pixel that a surface covers, in 2^-16, with the flag DEFRAY_SYNTHESISED. Empty:
  /// every surface is whole, and all were seen.
  Words coverage = {};
  /// The picture's pixel whose data (ids, normals) a surface has; DEFRAY_EMPTY: none, it was made
  /// up. Empty: each has its own pixel's.
  Words data_of = {};
  /// The rows that are wanted of a stage, where it is not all of them: of its planes no more than
  /// those that it looks at for these need be there. The first is a multiple of band_step.
  std::optional<Rows> wanted = {};
  /// What radii there are at most, where not all planes are there.
  std::optional<CocRange> known_range = {};

  Rows wanted_rows() const { return wanted.value_or(Rows{0, height}); }
  /// Of all radii, or of more.
  CocRange coc_range() const;

  std::size_t index(int x, int y, int layer = 0) const {
    return (size(y) * size(layers) + size(layer)) * size(width) + size(x);
  }
  /// Of one layer: the pixel nearest to a place that may lie beyond the edges.
  std::size_t index_within(int x, int y) const {
    return index(std::clamp(x, 0, width - 1), std::clamp(y, 0, height - 1));
  }
  std::size_t pixels() const { return size(width) * size(height); }
  std::size_t surfaces() const { return pixels() * size(layers); }

  /// Index of the front surface of a pixel, counted row by row.
  std::size_t front_of(std::size_t pixel) const {
    return pixel / size(width) * size(layers) * size(width) + pixel % size(width);
  }

  bool is_in_margin(std::size_t pixel) const;
  bool is_in_margin(int x, int y) const {
    return x < margin || y < margin || x >= width - margin || y >= height - margin;
  }

  /// The picture's pixel whose data a surface has.
  std::uint32_t data_pixel(std::size_t surface) const;

  /// Another frame of the same size and place, without planes.
  Frame without_planes() const;
};

/// The depth of no surface: its bits are DEFRAY_EMPTY.
float no_fragment();
bool is_fragment(float depth);

}  // namespace defray
