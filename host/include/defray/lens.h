#pragma once
// The lens: the thin lens of physical units, and the shape of its aperture.
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace defray {

/// Which picture the pinhole frame is.
enum class LensModel {
  cg,         ///< Field of view fixed by the focal length; a renderer's thin-lens camera.
  breathing,  ///< Textbook camera: image distance, and with it the field of view, follows focus.
};

struct Lens {
  double focal_length_mm = 50;
  double aperture_diameter_mm = 50 / 2.8;  ///< Focal length over f-number; 0: a pinhole.
  double sensor_width_mm = 36;             ///< Across the display window.
  /// Pixels per metre of image plane, whatever the frame's width; 0: from the sensor width.
  double pixels_per_metre = 0;
  double focus_distance_units = 0;  ///< Planar, scene units; infinity is allowed.
  double metres_per_unit = 1;       ///< Scene unit.
  double max_coc_px = 0;            ///< Limit of the radius; 0: none.
  LensModel model = LensModel::cg;
  /// Where what is kept sharp ends: it begins at the focus distance, and CoCs are measured from the
  /// nearer end. 0: the plane of focus alone.
  double focus_end_units = 0;
};

/// The aperture: the shape of the hole that light passes, and so of every out-of-focus highlight.
///
/// Lens coordinates (u, v): 1 is the radius of the circle that the f-number speaks of; u points
/// right, v down, as in the picture. A point p with a CoC of signed radius r lights x = p + r (u,
/// v): behind the plane of focus (r > 0) the aperture shows upright, in front of it turned by 180
/// degrees.
///
/// Every shape lies within the unit disc (a picture: the square around it) and touches it: an iris
/// of blades lets less light through than the circle around it, as in Cycles and Arnold. The
/// picture does not get darker: a method divides by the light of the whole shape.
struct Aperture {
  /// 0: a circle; else corners of a regular polygon, 3 to 32.
  int blades = 0;
  /// Of the blades' edges, arcs through two corners: 0 straight, 1 the circle, below 0 hollow, to
  /// -1 (the circle's arc mirrored; from 4 blades on, fewer would overlap). Arnold's blade
  /// curvature.
  double curvature = 0;
  /// Of the iris, counter-clockwise in the picture behind the focus; at 0 the middle of a blade is
  /// on the right, as in Cycles.
  double rotation_deg = 0;
  /// Height of the shape over its width, 0.125 to 8, after rotation; the longer side keeps its
  /// size. 2 is the upright oval of a 2x anamorphic lens. Cycles and Blender call it the ratio.
  double squeeze = 1;
  /// A picture of the bokeh instead of blades (.png, .exr, ...), in linear light; its longer side
  /// spans the square, so that the picture as it is shows behind the focus.
  std::string image;
  /// Optical vignetting, 0 to 1: how far, at the frame's corner, the lens rim's circle is from the
  /// aperture's, in its radii.
  double cats_eye = 0;

  bool operator==(const Aperture&) const = default;
};

/// Which side of the frame the sensor's size spans.
enum class SensorFit {
  horizontal,  ///< The sensor's width, the frame's.
  vertical,    ///< The sensor's height, the frame's.
  longer,      ///< The sensor's width, the frame's longer side: Blender's "Auto".
};

/// Lens values as a source (a camera file, an image's metadata, a user) states them; whatever it
/// does not state is empty.
struct CameraValues {
  std::optional<double> focal_length_mm;
  std::optional<double> sensor_width_mm;
  std::optional<double> sensor_height_mm;  ///< Of SensorFit::vertical.
  std::optional<double> fov_deg;  ///< Across the side that `fit` says; instead of a sensor.
  std::optional<SensorFit> fit;   ///< Without one: vertical where only a height is stated.
  std::optional<double> pixels_per_metre;  ///< Instead of the sensor width.
  std::optional<double> fstop;
  std::optional<double> aperture_diameter_mm;
  std::optional<double> focus_distance_units;
  std::optional<double> focus_end_units;  ///< Lens::focus_end_units.
  /// How large the scene is to look: the aperture is divided by this (Glatzel & Wilhelm, eq. 6).
  std::optional<double> perceived_scale;
  /// The same by the distance at which the plane of focus seems to be, metres (eq. 5).
  std::optional<double> perceived_distance_m;
  std::string sensor_source;  ///< The file that the sensor or field of view is from; else empty.
  std::string source;         ///< Where they are from, for messages; empty: the command line.
  /// By field, under which names that source was searched in vain.
  std::map<std::string, std::string> sought;
  std::vector<std::string> notes;  ///< What else its user should know of it.

  /// Values of `over` win over these.
  CameraValues overridden_by(const CameraValues& over) const;
};

}  // namespace defray
