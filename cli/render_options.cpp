// The options of defray render.
#include <charconv>
#include <cmath>
#include <regex>

#include "options.h"
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

/// An empty value is most likely an unset shell variable.
std::string not_empty(const std::string& text) { return text.empty() ? "is empty" : ""; }

void add_files(CLI::App& c, RenderOptions& o) {
  c.add_option("input", o.input, "Colour, and depth unless --depth is given; #### or %04d: frames")
      ->required();
  c.add_option("-o,--output", o.output, "EXR, TIFF, HDR (linear), PNG, JPEG (sRGB-encoded)")
      ->required();
  const char* const files = "Files";
  c.add_option("--depth", o.depth, "Take depth from this file")->group(files)->check(not_empty);
  c.add_option("--coc-out", o.coc_out, "Write the signed CoC radius in px (.exr, .tif)")
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

void add_method(CLI::App& c, RenderOptions& o) {
  const char* const group = "Method";
  c.add_option("--method", o.method, "rdb: ray distribution buffer (Shinya 1994)")->group(group);
  c.add_option("--rdb", o.rdb, "Lens cells a side, 1 to 64")->group(group);
  c.add_flag("--jitter", o.jitter, "Shift each pixel's lens samples: noise instead of patterns")
      ->group(group);
  c.add_option("--seed", o.seed, "Seed of the jitter")->group(group);
  c.add_option("--memory", o.memory_mib, "MiB for the ray distribution buffers")->group(group);
  c.add_option("--device", o.device, "Index or part of the name of 'defray devices'; reference")
      ->group(group);
  c.add_option("--work-group", o.work_group, "Work-group, 64x1; default: each kernel's own")
      ->group(group);
}

double parse_unit(const std::string& text) {
  static const std::map<std::string, double> metres{{"m", 1},     {"cm", 0.01},   {"mm", 0.001},
                                                    {"km", 1000}, {"ft", 0.3048}, {"in", 0.0254}};
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error == std::errc() && end == text.data() + text.size()) return number;
  return choice("--unit", text, metres);
}

/// A value that says "background", or nothing but infinity for "none".
double parse_background(const std::string& text) {
  if (text == "none") return INFINITY;
  double number = 0;
  const char* begin = text.data() + (text[0] == '+' ? 1 : 0);
  const auto [end, error] = std::from_chars(begin, text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) {
    fail(ExitCode::usage, "--background '{}' is neither a number nor none", text);
  }
  return number;
}

}  // namespace

void add_render_options(CLI::App& c, RenderOptions& o) {
  add_files(c, o);
  add_channels(c, o);
  add_lens(c, o);
  add_method(c, o);
  const char* const group = "Output to the terminal";
  c.add_flag("--json", o.json, "One JSON line a frame instead of text")->group(group);
  c.add_flag("-q,--quiet", o.quiet, "No text and no progress bar, errors excepted")->group(group);
  c.add_flag("--show", o.show, "Show the last picture until a key is pressed")->group(group);
  c.footer(footer);
}

RenderSettings to_settings(const RenderOptions& o) {
  RenderSettings s;
  choice<int>("--method", o.method, {{"rdb", 0}});
  s.request = {o.layer, o.view, o.depth_channel};
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
    fail(ExitCode::usage, "--max-coc is {} px: it must be above 0", *o.max_coc);
  }
  s.max_coc_px = o.max_coc.value_or(0);
  const CameraValues typed{o.focal_length,      o.sensor_width, o.fstop,
                           o.aperture_diameter, o.focus,        ""};
  s.camera_from_metadata = o.camera == "from-metadata";
  if (!o.focus_setting.empty() && (o.camera.empty() || s.camera_from_metadata)) {
    fail(ExitCode::usage, "--focus-setting goes with --camera FILE.json");
  }
  const bool has_file = !o.camera.empty() && !s.camera_from_metadata;
  s.camera =
      has_file ? read_camera_json(o.camera, o.focus_setting, s.metres_per_unit).overridden_by(typed)
               : typed;
  if (!s.camera_from_metadata) make_lens(s.camera, s.metres_per_unit, s.model, s.max_coc_px);
  make_lens_cells(o.rdb, o.jitter);
  if (!(o.memory_mib > 0) || o.memory_mib > 1048576) {
    fail(ExitCode::usage, "--memory is {} MiB: allowed are numbers above 0, up to 1048576",
         o.memory_mib);
  }
  s.rdb = {o.rdb, o.jitter, o.seed, static_cast<std::size_t>(o.memory_mib * 1048576)};
  return s;
}

std::array<std::size_t, 2> parse_work_group(const std::string& text) {
  if (text.empty()) return {0, 0};
  static const std::regex form(R"(([1-9]\d{0,5})(?:x([1-9]\d{0,5}))?)");
  std::smatch match;
  if (!std::regex_match(text, match, form)) {
    fail(ExitCode::usage, "--work-group '{}': write it as 64 or 64x1", text);
  }
  const std::size_t y = match[2].matched ? std::stoul(match[2]) : 1;
  return {std::stoul(match[1]), y};
}

}  // namespace defray::cli
