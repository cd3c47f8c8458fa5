#pragma once
// Pictures in memory: what render() takes and gives.
#include <cstdint>
#include <span>
#include <vector>

#include "defray/report.h"

namespace defray {

/// A rectangle of pixels; y points down.
struct Window {
  int x = 0, y = 0, width = 0, height = 0;
  bool operator==(const Window&) const = default;
};

/// A pinhole picture with depth, in the caller's memory. Planes are row by row from the top, one
/// value a pixel of the data window.
struct Picture {
  Window data;     ///< The pixels that there are; overscan lies outside the display window.
  Window display;  ///< The frame that the lens sees; empty: the data window.
  /// R G B or Y, linear light; or R G B A or Y A, premultiplied by alpha.
  std::vector<std::span<const float>> colour;
  /// Scene units along the camera's axis, unless Options::depth says otherwise; infinity is
  /// background. Empty for Method::tiltshift.
  std::span<const float> depth;
};

/// The lens picture. Planes are as those of the picture that was rendered.
struct RenderResult {
  std::vector<std::vector<float>> colour;  ///< As many planes as went in.
  std::vector<float> coc_px;  ///< Signed CoC radii, px: below 0 in front of the plane of focus.
  /// Share of each pixel's lens rays that end on what the picture shows, 0 to 1. Of Method::rdb
  /// with its stages; empty otherwise.
  std::vector<float> confidence;
  /// The pixel whose data (ids, normals) each pixel gets, its index in a plane: that of the nearest
  /// surface its rays end on, made-up ones left out; its own where there is none. Empty unless
  /// Options::wants_nearest.
  std::vector<std::uint32_t> nearest;
  /// RMS errors of sRGB-encoded values that are expected at each pixel: in all, then of each of
  /// ExpectedError::shares. Empty unless ErrorSettings::wants_planes.
  std::vector<std::vector<float>> expected_error;
  RenderReport report;
};

}  // namespace defray
