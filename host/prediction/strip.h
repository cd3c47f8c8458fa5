#pragma once
// What a row of blocks looks at: its own rows of pixels and one more on each side, where the frame
// ends its last ones again.
#include <span>
#include <vector>

#include "prediction/blocks.h"

namespace defray {

inline constexpr int strip_rows = block_px + 2;

/// Rows of values with one more at each end.
class StripRows {
 public:
  explicit StripRows(int width) : stride_(size(width) + 2), values_(stride_ * strip_rows) {}

  /// From -1 to block_px; points at the pixel of column 0.
  float* row(int j) { return &values_[size(j + 1) * stride_ + 1]; }
  const float* row(int j) const { return &values_[size(j + 1) * stride_ + 1]; }

 private:
  std::size_t stride_;
  Plane values_;
};

/// Of a frame and its lens picture.
class Strip {
 public:
  Strip(const Frame& frame, const std::vector<Plane>& result);

  std::size_t channels() const { return pinhole.size(); }

  /// The rows that begin at `y0`; sooner where they follow those that were loaded last.
  void load(int y0);

  std::vector<StripRows> pinhole, result;  ///< Shown values, a channel each.
  StripRows coc;                           ///< Signed radii, px.
  StripRows brightest;                     ///< Of the result's channels, linear.

 private:
  void load_row(int y, int j);
  void copy_row(int from, int to);

  int width_, height_;
  int next_ = -1;  ///< Where the rows end that are loaded.
  std::span<const std::int32_t> coc_quanta_;
  std::vector<std::span<const float>> pinhole_light_, result_light_;
};

/// sRGB-encoded, clipped to 0...1, to 1/1000 of itself; NaN is 0.
float shown(float linear);

// One row of a strip, a value a pixel.

/// Squared gradients, central differences, means over the channels.
void find_gradient(const std::vector<StripRows>& shown, int j, Plane& out);

/// Squared differences to the mean of 3x3 pixels, means over the channels.
void find_grain(const std::vector<StripRows>& shown, int j, Plane& out);

/// By how much values differ within 3x3 pixels.
void find_range(const StripRows& values, int j, Plane& out);

/// The largest of 3x3 pixels.
void find_largest(const StripRows& values, int j, Plane& out);

}  // namespace defray
