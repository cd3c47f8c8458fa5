#include "lens/depth.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "lens/lens.h"

namespace defray {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
/// Where a range begins at the camera, its 0 is as near as a float can be.
constexpr double nearest_float = std::numeric_limits<float>::min();
/// 1/z of a denormal lies farther than floats go: background too.
constexpr double farthest = std::numeric_limits<float>::max();

bool is_in_range(DepthKind kind) {
  return kind == DepthKind::normalized || kind == DepthKind::zbuffer;
}

/// A number of the wrong sign, and so only by rule background.
bool is_behind_camera(double stored, const DepthSettings& s) {
  if (s.background || is_in_range(s.kind)) return false;
  return s.kind == DepthKind::negative_z ? stored > 0 && stored < far_away : stored < 0;
}

/// Planar depth over distance along the ray through this pixel.
double planar_share(double x_px, double y_px, double pixel_focal_length) {
  return pixel_focal_length / std::hypot(pixel_focal_length, x_px, y_px);
}

double planar_depth(double stored, const DepthSettings& s, double share) {
  switch (s.kind) {
    case DepthKind::z:
      return stored;
    case DepthKind::distance:
      return stored * share;
    case DepthKind::inverse:
      return 1 / stored;
    case DepthKind::normalized: {
      const double t = s.invert ? 1 - stored : stored;
      const double z = s.near_units + t * (s.far_units - s.near_units);
      return z == 0 ? nearest_float : z;
    }
    case DepthKind::negative_z:
      return -stored;
    case DepthKind::zbuffer: {  // 1/z goes from 1/near to 1/far
      const double t = s.invert ? 1 - stored : stored;
      return 1 / ((1 - t) / s.near_units + t / s.far_units);
    }
  }
  fail(ErrorKind::internal, "a depth kind that is not known");
}

/// What to do about depths of the wrong sign.
std::string remedy(DepthKind kind) {
  if (kind == DepthKind::negative_z) return field("depth.kind") + " z is the usual sign";
  if (kind == DepthKind::inverse) return "1/z is above 0, 0 is background; turn its sign";
  return "it looks like camera-space -z; say so with " + field("depth.kind") + " negative-z";
}

/// Depths of the wrong sign, more of them than others, make no picture.
void refuse_wrong_sign(const DepthReport& r, const DepthSettings& s, std::size_t pixels,
                       const std::string& path) {
  if (r.behind_camera <= pixels - r.background) return;
  const bool is_minus = s.kind != DepthKind::negative_z;
  fail(ErrorKind::input, "{}: depth is {} in {} px ({:.1f} % of all), {} in {} px only: {}", path,
       is_minus ? "negative" : "positive", r.behind_camera,
       100.0 * static_cast<double>(r.behind_camera) / static_cast<double>(pixels),
       is_minus ? "positive" : "negative", pixels - r.background, remedy(s.kind));
}

/// What no zbuffer holds may be a distance.
void refuse_outside_range(double stored, int x, int y, DepthKind kind, const std::string& path) {
  if (!is_in_range(kind)) return;
  fail(
      ErrorKind::input,
      "{}: stored depth {} at pixel ({}, {}) lies outside 0 to 1, and so far that it is behind the "
      "camera; if the file holds distances, {} is z",
      path, stored, x, y, field("depth.kind"));
}

}  // namespace

bool is_background(double stored, const DepthSettings& s) {
  if (s.background) return stored == static_cast<double>(static_cast<float>(*s.background));
  if (is_in_range(s.kind)) return std::isinf(stored);
  if (s.kind == DepthKind::inverse) return stored <= 0;
  const double z = s.kind == DepthKind::negative_z ? -stored : stored;
  return z == largest_half || z >= far_away || z <= 0;
}

void validate(const DepthSettings& s) {
  require_named("depth.kind", s.kind, DepthKind::zbuffer);
  if (s.kind == DepthKind::normalized) {
    if (!(s.near_units >= 0) || !(s.far_units > s.near_units) || std::isinf(s.far_units)) {
      fail(ErrorKind::usage,
           "{} normalized needs 0 <= {} < {} in scene units; found near {} far {}",
           field("depth.kind"), field("near_units"), field("far_units"), s.near_units, s.far_units);
    }
  } else if (s.kind == DepthKind::zbuffer) {
    if (!(s.near_units > 0) || !(s.far_units > s.near_units)) {
      fail(ErrorKind::usage,
           "{} zbuffer needs 0 < {} < {} in scene units (a far of inf is allowed); found near {} "
           "far {}",
           field("depth.kind"), field("near_units"), field("far_units"), s.near_units, s.far_units);
    }
  } else if (s.invert) {
    fail(ErrorKind::usage, "{} goes with {} normalized or zbuffer only", field("invert"),
         field("depth.kind"));
  } else if (s.near_units != 0 || s.far_units != 0) {
    fail(ErrorKind::usage, "{} and {} go with {} normalized or zbuffer only", field("near_units"),
         field("far_units"), field("depth.kind"));
  }
}

DepthReport convert_depth(Plane& depth, const DepthSettings& settings, const Window& data,
                          const Window& display, double pixel_focal_length,
                          const std::string& path) {
  DepthReport report;
  report.nearest_units = infinity;
  const double centre_x = display.x + display.width / 2.0;
  const double centre_y = display.y + display.height / 2.0;
  std::size_t i = 0;
  for (int y = data.y; y < data.y + data.height; ++y) {
    for (int x = data.x; x < data.x + data.width; ++x, ++i) {
      const double stored = static_cast<double>(depth[i]);
      const bool is_nothing = !std::isfinite(stored) || is_background(stored, settings);
      report.outside_range +=
          is_in_range(settings.kind) && !is_nothing && (stored < 0 || stored > 1);
      report.behind_camera += std::isfinite(stored) && is_behind_camera(stored, settings);
      const double share =
          settings.kind == DepthKind::distance
              ? planar_share(x + 0.5 - centre_x, y + 0.5 - centre_y, pixel_focal_length)
              : 1;
      const double z = is_nothing ? infinity : planar_depth(stored, settings, share);
      if (z > farthest) {
        report.not_a_number += std::isnan(stored);
        ++report.background;
        depth[i] = std::numeric_limits<float>::infinity();
        continue;
      }
      depth[i] = static_cast<float>(z);
      if (!(depth[i] > 0)) {
        refuse_outside_range(stored, x, y, settings.kind, path);
        fail(ErrorKind::input,
             "{}: depth {} at pixel ({}, {}) is not in front of the camera (stored: {}); if it "
             "means background, say so with {} {}",
             path, z, x, y, stored, field("background"), stored);
      }
      report.nearest_units = std::min(report.nearest_units, z);
      report.farthest_units = std::max(report.farthest_units, z);
    }
  }
  if (report.background == depth.size()) report.nearest_units = 0;
  refuse_wrong_sign(report, settings, depth.size(), path);
  return report;
}

DepthReport convert_depth(Plane& depth, const DepthSettings& settings, const Window& data,
                          const Window& display, const Lens& lens, const std::string& path) {
  if (settings.kind == DepthKind::distance && lens.pixels_per_metre > 0) {
    fail(ErrorKind::usage,
         "{} distance needs the picture's field of view, which {} and {} do not state: convert the "
         "depth to planar z first",
         field("depth.kind"), field("eye"), field("pixels_per_metre"));
  }
  return convert_depth(depth, settings, data, display, pixel_focal_length(lens, display.width),
                       path);
}

}  // namespace defray
