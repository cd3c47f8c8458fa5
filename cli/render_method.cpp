// The options of defray render that choose a method, a device and their settings.
#include "lens/lens_cells.h"
#include "methods/gather.h"
#include "methods/tiltshift.h"
#include "options.h"
#include "render.h"

namespace defray::cli {
namespace {

const std::map<std::string, Method> methods{{"rdb", Method::rdb},
                                            {"linear", Method::linear},
                                            {"gather", Method::gather},
                                            {"tiltshift", Method::tiltshift}};

/// An option that means something to some methods only: on others it would do nothing.
struct MethodOption {
  const char* name;
  bool is_given;
  std::vector<std::string> methods;
};

void reject_foreign_options(const RenderOptions& o) {
  const std::vector<std::string> lens{"rdb", "linear", "gather"};
  const std::vector<MethodOption> options{
      {"--rdb", o.rdb.has_value(), {"rdb"}},
      {"--literal", o.literal, {"rdb"}},
      {"--quality", !o.quality.empty(), {"rdb"}},
      {"--hidden", !o.hidden.empty(), {"rdb"}},
      {"--edges", !o.edges.empty(), {"rdb"}},
      {"--highlights", !o.highlights.empty(), {"rdb"}},
      {"--border", !o.border.empty(), {"rdb"}},
      {"--keep-depth", o.keep_depth, {"rdb"}},
      {"--confidence-out", !o.confidence_out.empty(), {"rdb"}},
      {"--blades", o.aperture.blades.has_value(), {"rdb"}},
      {"--blade-curvature", o.aperture.curvature.has_value(), {"rdb"}},
      {"--blade-rotation", o.aperture.rotation_deg.has_value(), {"rdb"}},
      {"--squeeze", o.aperture.squeeze.has_value(), {"rdb"}},
      {"--aperture-image", !o.aperture.image.empty(), {"rdb"}},
      {"--cats-eye", o.aperture.cats_eye.has_value(), {"rdb"}},
      {"--channels", o.channels.has_value(), {"rdb"}},
      {"--jitter", o.jitter, {"rdb"}},
      {"--samples", o.samples.has_value(), {"gather"}},
      {"--passes", o.passes.has_value(), {"gather"}},
      {"--gather", !o.gather.empty(), {"gather"}},
      {"--rotate", o.rotate, {"gather"}},
      {"--seed", o.seed.has_value(), {"rdb", "gather"}},
      {"--band-centre", o.band_centre.has_value(), {"tiltshift"}},
      {"--band-width", o.band_width.has_value(), {"tiltshift"}},
      {"--max-blur", o.max_blur.has_value(), {"tiltshift"}},
      {"--depth", !o.depth.empty(), lens},
      {"--depth-channel", !o.depth_channel.empty(), lens},
      {"--focus", o.focus.has_value(), lens},
      {"--fstop", o.fstop.has_value(), lens},
      {"--aperture-diameter", o.aperture_diameter.has_value(), lens},
      {"--focal-length", o.focal_length.has_value(), lens},
      {"--sensor-width", o.sensor_width.has_value(), lens},
      {"--pixel-scale", o.pixel_scale.has_value(), lens},
      {"--scale", o.scale.has_value(), lens},
      {"--perceived-distance", o.perceived_distance.has_value(), lens},
      {"--eye", !o.eye.empty(), lens},
      {"--max-coc", o.max_coc.has_value(), lens},
      {"--camera", !o.camera.empty(), lens},
      {"--focus-setting", !o.focus_setting.empty(), lens},
      {"--display-distance", o.display_distance.has_value(), lens},
      {"--display-resolution", o.display_resolution.has_value(), lens},
      {"--lens-model", o.lens_model != "cg", lens},
      {"--depth-kind", o.depth_kind != "z", lens},
      {"--near", o.near_units != 0, lens},
      {"--far", o.far_units != 0, lens},
      {"--invert", o.invert, lens},
      {"--background", !o.background.empty(), lens},
      {"--unit", o.unit != "m", lens},
      {"--memory", o.memory_mib.has_value(), {"rdb", "linear", "tiltshift"}}};
  for (const MethodOption& option : options) {
    const auto& known = option.methods;
    if (!option.is_given || std::find(known.begin(), known.end(), o.method) != known.end())
      continue;
    fail(ErrorKind::usage, "{} means nothing to --method {}: it goes with {}", option.name,
         o.method, join(known, ", "));
  }
  if (o.device == "reference") {
    const std::pair<const char*, bool> of_kernels[] = {{"--work-group", !o.work_group.empty()},
                                                       {"--memory", o.memory_mib.has_value()},
                                                       {"--math", o.math != "strict"}};
    for (const auto& [name, is_given] : of_kernels) {
      if (is_given) fail(ErrorKind::usage, "{} means nothing to --device reference", name);
    }
  }
  if (o.method == "rdb" && o.jitter && !o.literal) {
    fail(ErrorKind::usage, "--jitter goes with --literal: other lens points leave no pattern");
  }
  if (o.literal) {
    const std::pair<const char*, bool> of_stages[] = {
        {"--quality", !o.quality.empty()},
        {"--hidden", !o.hidden.empty()},
        {"--edges", !o.edges.empty()},
        {"--highlights", !o.highlights.empty()},
        {"--border", !o.border.empty()},
        {"--keep-depth", o.keep_depth},
        {"--confidence-out", !o.confidence_out.empty()},
        {"--blades", o.aperture.blades.has_value()},
        {"--blade-curvature", o.aperture.curvature.has_value()},
        {"--blade-rotation", o.aperture.rotation_deg.has_value()},
        {"--squeeze", o.aperture.squeeze.has_value()},
        {"--aperture-image", !o.aperture.image.empty()},
        {"--cats-eye", o.aperture.cats_eye.has_value()}};
    for (const auto& [name, is_given] : of_stages) {
      if (is_given) fail(ErrorKind::usage, "{} means nothing to --literal", name);
    }
  }
  if (o.method == "rdb" && o.seed && !o.jitter) {
    fail(ErrorKind::usage, "--seed goes with --jitter: without it nothing is random");
  }
}

}  // namespace

void add_method_options(CLI::App& c, RenderOptions& o) {
  const char* const group = "Method";
  c.add_option("--method", o.method,
               "rdb: ray distribution buffer (Shinya); linear: each pixel spread over its CoC, "
               "nothing occluded (Potmesil); gather: Poisson-disk samples (Glatzel & Wilhelm); "
               "tiltshift: a vertical gradient, no depth, no lens")
      ->group(group);
  c.add_option("--rdb", o.rdb,
               "rdb: lens cells a side, 1 to 64: as many lens points as round cells; default: by "
               "--quality, 9 with --literal")
      ->group(group);
  c.add_flag("--literal", o.literal,
             "rdb: the paper alone: a grid of lens cells, visible pixels only, none of the stages")
      ->group(group);
  c.add_flag("--jitter", o.jitter,
             "rdb --literal: shift each pixel's lens samples, noise for patterns")
      ->group(group);
  c.add_option("--gather", o.gather,
               "gather: aware (default) weighs samples by whether their light arrives; literal is "
               "the paper, and bleeds")
      ->group(group);
  c.add_option("--samples", o.samples, "gather: samples a pass, 1 to 1024; default 32")
      ->group(group);
  c.add_option("--passes", o.passes, "gather: 1 to 8; default 2")->group(group);
  c.add_flag("--rotate", o.rotate, "gather: turn each pixel's samples, noise for patterns")
      ->group(group);
  c.add_option("--seed", o.seed, "Seed of the jitter, or of gather's samples; default 0")
      ->group(group);
  c.add_option("--band-centre", o.band_centre,
               "tiltshift: middle of the sharp band, 0 top to 1 bottom; default 0.5")
      ->group(group);
  c.add_option("--band-width", o.band_width,
               "tiltshift: height of the sharp band, in frame heights; default 0.2")
      ->group(group);
  c.add_option("--max-blur", o.max_blur,
               "tiltshift: blur radius at the farthest edge, px; default 9.2")
      ->group(group);
  c.add_option("--memory", o.memory_mib, "rdb, linear, tiltshift: MiB for buffers; default 512")
      ->group(group);
  c.add_option("--device", o.device, "Index or part of the name of 'defray devices'; reference")
      ->group(group);
  c.add_option("--math", o.math,
               "strict: the same bits on every device; fast: the compiler may fuse and approximate")
      ->group(group);
  c.add_option("--work-group", o.work_group, "Work-group, 64x1; default: each kernel's own")
      ->group(group);
}

std::size_t memory_bytes(const RenderOptions& o) {
  const double mib = o.memory_mib.value_or(512);
  if (!(mib > 0) || mib > 1048576) {
    fail(ErrorKind::usage, "--memory is {} MiB: allowed are numbers above 0, up to 1048576", mib);
  }
  return static_cast<std::size_t>(mib * 1048576);
}

MethodSettings to_method(const RenderOptions& o) {
  MethodSettings s;
  s.method = choice<Method>("--method", o.method, methods);
  reject_foreign_options(o);
  memory_bytes(o);
  s.rdb.cells_per_side = o.rdb.value_or(9);
  s.rdb.jitter = o.jitter;
  s.rdb.seed = o.seed.value_or(0);
  make_lens_cells(s.rdb.cells_per_side, o.jitter);
  if (s.method == Method::rdb && !o.literal) s.chain = to_chain(o);
  s.gather.kind =
      choice<GatherKind>("--gather", o.gather.empty() ? "aware" : o.gather,
                         {{"aware", GatherKind::aware}, {"literal", GatherKind::literal}});
  s.gather.samples = o.samples.value_or(32);
  s.gather.passes = o.passes.value_or(2);
  s.gather.rotate = o.rotate;
  s.gather.seed = o.seed.value_or(0);
  validate(s.gather);
  return s;
}

TiltshiftSettings to_tiltshift(const RenderOptions& o) {
  const TiltshiftSettings defaults;
  const TiltshiftSettings s{o.band_centre.value_or(defaults.band_centre),
                            o.band_width.value_or(defaults.band_width),
                            o.max_blur.value_or(defaults.max_blur_px)};
  validate(s);
  return s;
}

}  // namespace defray::cli
