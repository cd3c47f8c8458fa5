// The options of defray render.
#include <cmath>

#include "image/further_channels.h"
#include "lens/camera.h"
#include "lens/depth.h"
#include "options.h"
#include "parse.h"
#include "render.h"

namespace defray::cli {
namespace {

constexpr const char* footer =
    R"(Units: focus, --near, --far and depth in scene units (--unit says what one is); focal length,
sensor and aperture in millimetres; CoC in pixels (radius, negative in front of the focus).

Examples:
  defray render beauty.exr -o out.exr --focus 3 --fstop 2.8 --focal-length 50 --sensor-width 36
  defray render 'shot.####.exr' -o 'out/shot.####.exr' --frames 1-8 --camera camera.json
  defray render beauty.png --depth z.exr -o out.png --focus 1.2 --fstop 1.4 --focal-length 35
  defray render vray.exr -o out.exr --depth-kind normalized --invert --near 0.5 --far 40 \
      --focus 3 --fstop 4 --focal-length 50)";

void add_files(CLI::App& c, RenderOptions& o) {
  c.add_option("input", o.input, "Colour, and depth unless --depth is given; #### or %04d: frames")
      ->required();
  c.add_option("-o,--output", o.output, "EXR, TIFF, HDR (linear), PNG, JPEG (sRGB-encoded)")
      ->required();
  const char* const files = "Files";
  c.add_option("--depth", o.depth, "Take depth from this file")->group(files);
  c.add_option("--coc-out", o.coc_out, "Write the signed CoC radius in px (.exr, .tif)")
      ->group(files);
  c.add_option("--confidence-out", o.confidence_out,
               "Write the share of each pixel's lens rays that the input determines (.exr, .tif)")
      ->group(files);
  c.add_option("--frames", o.frames, "1-8, 1-10x2, 1,5,9-12; default: every file that matches")
      ->group(files);
  c.add_flag("--skip-existing", o.skip_existing, "Leave frames alone whose output exists")
      ->group(files);
  c.add_flag("--skip-bad-frames", o.skip_bad_frames,
             "Report a frame that fails, go on, exit with 1 at the end")
      ->group(files);
}

void add_channels(CLI::App& c, RenderOptions& o) {
  const char* const group = "Channels and depth";
  c.add_option("--layer", o.layer, "Colour layer, 'ViewLayer.Combined'")->group(group);
  c.add_option("--view", o.view, "Stereo view, 'left'")->group(group);
  c.add_option("--depth-channel", o.depth_channel, "Depth channel by its full name, 'depth.Z'")
      ->group(group);
  c.add_option(
       "--channels", o.channels,
       "Further channels for the lens, 'diffuse.*,N.*': light is averaged as colour is; data "
       "gets the value of the nearest hit. Data: " +
           data_channel_rules())
      ->group(group);
  c.add_option("--depth-kind", o.depth_kind,
               "z: planar; distance: along the ray; inverse: 1/z; normalized: 0 near, 1 far")
      ->group(group);
  c.add_option("--near", o.near_units, "Depth of 0, scene units (normalized)")->group(group);
  c.add_option("--far", o.far_units, "Depth of 1, scene units (normalized)")->group(group);
  c.add_flag("--invert", o.invert, "1 is near, 0 is far (normalized)")->group(group);
  c.add_option("--unit", o.unit, "Scene unit: m, cm, mm, km, ft, in, or its length in metres")
      ->group(group);
  c.add_option("--background", o.background,
               "Stored depth that means background, or none; default: 65504, >= 1e9, inf, <= 0")
      ->group(group);
  c.add_option("--nonfinite", o.nonfinite, "NaN and Inf colours: error, zero, keep")->group(group);
}

void add_lens(CLI::App& c, RenderOptions& o) {
  const char* const group = "Lens";
  c.add_option("--focus", o.focus, "Focus distance, planar, scene units; inf is allowed")
      ->group(group);
  c.add_option("--fstop", o.fstop, "f-number")->group(group);
  c.add_option("--aperture-diameter", o.aperture_diameter, "mm, instead of --fstop; 0: pinhole")
      ->group(group);
  c.add_option("--focal-length", o.focal_length, "mm")->group(group);
  c.add_option("--sensor-width", o.sensor_width, "mm across the display window; default 36")
      ->group(group);
  c.add_option("--pixel-scale", o.pixel_scale,
               "Pixels per metre of image plane, instead of --sensor-width")
      ->group(group);
  c.add_flag("--eye{retina}", o.eye,
             "An eye's lens: 4.6 mm, 17 mm, 28000 px/m; --eye=display: 4 mm, 24 mm, by a display")
      ->group(group);
  c.add_option("--display-distance", o.display_distance, "m, of --eye=display; default 0.6")
      ->group(group);
  c.add_option("--display-resolution", o.display_resolution,
               "px per metre, of --eye=display; default 3780 (96 dpi)")
      ->group(group);
  c.add_option("--scale", o.scale,
               "Make the scene look this much of its size: divides the aperture")
      ->group(group);
  c.add_option("--perceived-distance", o.perceived_distance,
               "m; as --scale, so that the plane of focus seems this far away")
      ->group(group);
  c.add_option("--camera", o.camera,
               "camera.json, or from-metadata: the image's own. Options above win over it")
      ->group(group);
  c.add_option("--focus-setting", o.focus_setting, "Which focus setting of camera.json")
      ->group(group);
  c.add_option("--lens-model", o.lens_model,
               "cg: a renderer's thin lens; breathing: field of view follows focus")
      ->group(group);
  c.add_option("--max-coc", o.max_coc, "Limit of the CoC radius, px; default: none")->group(group);
}

CameraValues typed_values(const RenderOptions& o) {
  CameraValues typed;
  typed.focal_length_mm = o.focal_length;
  typed.sensor_width_mm = o.sensor_width;
  typed.pixels_per_metre = o.pixel_scale;
  typed.fstop = o.fstop;
  typed.aperture_diameter_mm = o.aperture_diameter;
  typed.focus_distance_units = o.focus;
  typed.perceived_scale = o.scale;
  typed.perceived_distance_m = o.perceived_distance;
  return typed;
}

/// The eye asked for; no values without one.
CameraValues eye_of(const RenderOptions& o) {
  const auto eye =
      o.eye.empty()
          ? Eye::retina
          : choice<Eye>("--eye", o.eye, {{"retina", Eye::retina}, {"display", Eye::display}});
  if ((o.display_distance || o.display_resolution) && (o.eye.empty() || eye != Eye::display)) {
    fail(ErrorKind::usage, "--display-distance and --display-resolution go with --eye=display");
  }
  for (const double value : {o.display_distance.value_or(1), o.display_resolution.value_or(1)}) {
    if (!(value > 0) || std::isinf(value)) {
      fail(ErrorKind::usage, "--display-distance and --display-resolution must be above 0, not {}",
           value);
    }
  }
  if (o.eye.empty()) return {};
  return eye_values(eye, o.display_distance.value_or(0.6), o.display_resolution.value_or(3780));
}

/// Typed values win over the eye's, those over the camera file's or the metadata's.
void read_lens(const RenderOptions& o, RenderSettings& s) {
  s.camera_from_metadata = o.camera == "from-metadata";
  const bool has_file = !o.camera.empty() && !s.camera_from_metadata;
  if (!o.focus_setting.empty() && !has_file) {
    fail(ErrorKind::usage, "--focus-setting goes with --camera FILE.json");
  }
  if (has_file) s.camera = read_camera_json(o.camera, o.focus_setting, s.metres_per_unit);
  s.camera = s.camera.overridden_by(eye_of(o)).overridden_by(typed_values(o));
  if (!s.camera_from_metadata) make_lens(s.camera, s.metres_per_unit, s.model, s.max_coc_px);
}

}  // namespace

void add_render_options(CLI::App& c, RenderOptions& o) {
  add_files(c, o);
  add_channels(c, o);
  add_lens(c, o);
  add_method_options(c, o);
  add_defocus_options(c, o);
  const char* const group = "Output to the terminal";
  c.add_flag("--json", o.json, "One JSON line a frame instead of text")->group(group);
  c.add_flag("-q,--quiet", o.quiet, "No text and no progress bar, errors excepted")->group(group);
  c.add_flag("--show", o.show, "Show the last picture until a key is pressed")->group(group);
  c.footer(footer);
}

RenderSettings to_settings(const RenderOptions& o) {
  RenderSettings s;
  s.method = to_method(o);
  s.tiltshift = to_tiltshift(o);
  s.request = {o.layer, o.view, o.depth_channel};
  if (o.channels) s.channels = parse_channel_list(*o.channels);
  s.depth.kind = choice<DepthKind>("--depth-kind", o.depth_kind,
                                   {{"z", DepthKind::z},
                                    {"distance", DepthKind::distance},
                                    {"inverse", DepthKind::inverse},
                                    {"normalized", DepthKind::normalized}});
  s.depth.invert = o.invert;
  s.depth.near_units = o.near_units;
  s.depth.far_units = o.far_units;
  if (!o.background.empty()) s.depth.background = parse_background(o.background);
  validate(s.depth);
  s.metres_per_unit = parse_unit(o.unit);
  s.model = choice<LensModel>("--lens-model", o.lens_model,
                              {{"cg", LensModel::cg}, {"breathing", LensModel::breathing}});
  s.nonfinite = choice<Nonfinite>(
      "--nonfinite", o.nonfinite,
      {{"error", Nonfinite::error}, {"zero", Nonfinite::zero}, {"keep", Nonfinite::keep}});
  if (o.max_coc && !(*o.max_coc > 0)) {
    fail(ErrorKind::usage, "--max-coc is {} px: it must be above 0", *o.max_coc);
  }
  s.max_coc_px = o.max_coc.value_or(0);
  if (s.method.method != Method::tiltshift) read_lens(o, s);
  return s;
}

}  // namespace defray::cli
