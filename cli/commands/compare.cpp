// defray compare: how far two pictures are apart.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/error.h"
#include "commands.h"
#include "commands/colour_file.h"
#include "exit_code.h"
#include "image/channels.h"
#include "image/display.h"
#include "image/output.h"
#include "lens/camera.h"
#include "lens/depth.h"
#include "measure/edge_band.h"
#include "measure/metrics.h"
#include "reference/twin_backend.h"

namespace defray::cli {
namespace {

using Json = nlohmann::ordered_json;

struct CompareOptions {
  std::string a, b;
  std::optional<double> min_psnr, min_ssim, max_error;
  std::string depth, depth_channel, camera, focus_setting;
  std::string windows = "union", crop, mask;
  double edge_step = 0.1;
  std::string sheet;
  double amplify = 4;
  bool json = false;
};

/// Errors inside the edge band and outside it.
struct BandErrors {
  Errors inside, outside;
};

void validate(const CompareOptions& o) {
  const auto refuse_nan = [](const char* name, const std::optional<double>& value) {
    if (value && std::isnan(*value)) fail(ErrorKind::usage, "{} is not a number", name);
  };
  refuse_nan("--min-psnr", o.min_psnr);
  refuse_nan("--min-ssim", o.min_ssim);
  refuse_nan("--max-error", o.max_error);
  if (o.min_ssim && std::fabs(*o.min_ssim) > 1) {
    fail(ErrorKind::usage, "--min-ssim is {}: SSIM lies between -1 and 1", *o.min_ssim);
  }
  if (o.max_error && *o.max_error < 0) {
    fail(ErrorKind::usage, "--max-error is {}: it must be 0 or more", *o.max_error);
  }
  if (!(o.amplify > 0) || !std::isfinite(o.amplify)) {
    fail(ErrorKind::usage, "--amplify is {}: it must be a finite number above 0", o.amplify);
  }
  if (!o.sheet.empty()) check_sheet(o.sheet, {o.a, o.b, o.depth, o.camera, o.mask});
}

/// The edge band of the pinhole frame that `picture` was rendered from.
std::vector<std::uint8_t> read_band(const CompareOptions& o, const ColourFile& picture) {
  const ImageFile file = ImageFile::read(o.depth, Content::data);
  const ChannelName name = choose_depth(o.depth, file.parts(), {"", "", o.depth_channel}, {});
  const PartInfo& part = file.parts()[static_cast<std::size_t>(name.part)];
  require_same_size({o.depth, {}, part.data, part.display}, picture);
  const Lens lens =
      make_lens(read_camera_json(o.camera, o.focus_setting, 1), 1, LensModel::cg, 0, part.display);
  Plane depth = file.plane(name.part, name.channel);
  const int width = part.display.width;
  convert_depth(depth, {}, part.data, part.display, pixel_focal_length(lens, width), o.depth);
  return edge_band(depth, part.data.width, reference::TwinBackend().coc(lens, width, depth).host(),
                   o.edge_step);
}

/// 1 where the mask's first channel is above a half.
std::vector<std::uint8_t> read_mask(const CompareOptions& o, const Window& data) {
  const ImageFile file = ImageFile::read(o.mask, Content::data);
  const PartInfo& part = file.parts().front();
  const Plane values = to_display_window({file.plane(0, 0)}, part.data, data).front();
  std::vector<std::uint8_t> mask(values.size());
  std::transform(values.begin(), values.end(), mask.begin(), [](float v) { return v > 0.5f; });
  if (std::count(mask.begin(), mask.end(), 1) == 0) {
    fail(ErrorKind::input, "{}: no pixel of the mask is above a half where the pictures are",
         o.mask);
  }
  return mask;
}

/// Looks at the mask's pixels alone: outside, both pictures are alike.
Comparison compare_where(const ColourFile& a, const ColourFile& b,
                         const std::vector<std::uint8_t>& mask) {
  std::vector<Plane> planes = b.planes;
  for (std::size_t c = 0; c < planes.size(); ++c) {
    for (std::size_t i = 0; i < mask.size(); ++i) {
      if (!mask[i]) planes[c][i] = a.planes[c][i];
    }
  }
  Comparison found = compare(a.planes, planes, a.data.width);
  static_cast<Errors&>(found) = errors_where(a.planes, b.planes, mask, 1);
  return found;
}

Json errors_json(const Errors& e) {
  return {{"pixels", e.pixels},
          {"psnr_srgb_db", e.psnr_srgb_db},
          {"psnr_linear_db", e.psnr_linear_db},
          {"rms", e.rms}};
}

void print_json(const Comparison& c, const std::optional<BandErrors>& band) {
  Json line = {{"equal", c.worst == 0},
               {"psnr_srgb_db", c.psnr_srgb_db},
               {"psnr_linear_db", c.psnr_linear_db},
               {"rms", c.rms},
               {"worst", c.worst},
               {"worst_x", c.worst_x},
               {"worst_y", c.worst_y},
               {"worst_a", c.worst_a},
               {"worst_b", c.worst_b},
               {"ssim", c.ssim},
               {"energy_ratio", c.energy_ratio}};
  if (band) {
    line["edge_band"] = errors_json(band->inside);
    line["outside_edge_band"] = errors_json(band->outside);
  }
  fmt::print("{}\n", line.dump());
}

void print_errors(const char* where, const Errors& e) {
  if (e.pixels == 0) {
    fmt::print("{} 0 px\n", where);
    return;
  }
  fmt::print("{} {} px: PSNR {:.2f} dB (sRGB-encoded), {:.2f} dB (linear), RMS error {:.6g}\n",
             where, e.pixels, e.psnr_srgb_db, e.psnr_linear_db, e.rms);
}

void print_text(const Comparison& c, const std::optional<BandErrors>& band) {
  fmt::print("PSNR {:.2f} dB (sRGB-encoded), {:.2f} dB (linear), both clipped to 0...1\n",
             c.psnr_srgb_db, c.psnr_linear_db);
  fmt::print("RMS error {:.6g}, worst {:.6g} at pixel ({}, {}) (linear, not clipped)\n", c.rms,
             c.worst, c.worst_x, c.worst_y);
  fmt::print("  there {:.6g} against {:.6g} (R G B)\n", fmt::join(c.worst_a, " "),
             fmt::join(c.worst_b, " "));
  fmt::print("SSIM {:.4f} (sRGB-encoded, mean of R G B), energy ratio {:.6g}\n", c.ssim,
             c.energy_ratio);
  if (!band) return;
  print_errors("edge band", band->inside);
  print_errors("outside it", band->outside);
}

/// Says which bounds are missed. A NaN is never good enough.
bool misses_a_bound(const CompareOptions& o, const Comparison& c) {
  bool misses = false;
  const auto check = [&](const char* option, const std::optional<double>& bound, double found,
                         bool is_kept) {
    if (!bound || is_kept) return;
    fmt::print(stderr, "defray: {} {:g} is missed: {:.6g}\n", option, *bound, found);
    misses = true;
  };
  check("--min-psnr", o.min_psnr, c.psnr_srgb_db, c.psnr_srgb_db >= o.min_psnr.value_or(0));
  check("--min-ssim", o.min_ssim, c.ssim, c.ssim >= o.min_ssim.value_or(0));
  check("--max-error", o.max_error, c.worst, c.worst <= o.max_error.value_or(0));
  return misses;
}

int run(const CompareOptions& o) {
  validate(o);
  ColourFile a = read_colour_file(o.a), b = read_colour_file(o.b);
  Region region;
  set_region(region, o.windows, o.crop);
  std::optional<BandErrors> band;
  if (!o.depth.empty()) require_same_size(a, b);
  bring_together({&a, &b}, region);
  if (!o.depth.empty()) {
    const std::vector<std::uint8_t> mask = read_band(o, a);
    band = {errors_where(a.planes, b.planes, mask, 1), errors_where(a.planes, b.planes, mask, 0)};
  }
  Comparison comparison = o.mask.empty() ? compare(a.planes, b.planes, a.data.width)
                                         : compare_where(a, b, read_mask(o, a.data));
  // From the display window's left upper corner, as --crop is.
  comparison.worst_x += a.data.x - a.display.x;
  comparison.worst_y += a.data.y - a.display.y;
  if (o.json) {
    print_json(comparison, band);
  } else {
    print_text(comparison, band);
  }
  if (!o.sheet.empty()) {
    std::vector<Plane> difference = difference_picture(a.planes, b.planes, o.amplify);
    write_sheet(o.sheet,
                {{"A: " + o.a, std::move(a.planes)},
                 {"B: " + o.b, std::move(b.planes)},
                 {fmt::format("|A - B| x {:g}", o.amplify), std::move(difference)}},
                a.data.width, a.data.height);
  }
  return misses_a_bound(o, comparison) ? ExitCode::failed : ExitCode::ok;
}

}  // namespace

Run add_compare(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "compare", "Compare two pictures: PSNR, SSIM, worst pixel, errors near depth edges");
  auto o = std::make_shared<CompareOptions>();
  command->add_option("a", o->a, "Picture")->required();
  command->add_option("b", o->b, "Picture of the same size, for instance the truth")->required();
  command->add_option("--min-psnr", o->min_psnr, "Exit with 1 below this PSNR, dB, sRGB-encoded");
  command->add_option("--min-ssim", o->min_ssim, "Exit with 1 below this SSIM, -1 to 1");
  command->add_option("--max-error", o->max_error,
                      "Exit with 1 if a linear value differs by more than this");
  auto* depth = command->add_option(
      "--depth", o->depth, "Planar depth in metres: also give the errors in the edge band");
  auto* camera = command->add_option("--camera", o->camera, "camera.json: the lens, for --depth");
  depth->needs(camera);
  camera->needs(depth);
  command->add_option("--depth-channel", o->depth_channel, "Which channel of the depth file")
      ->needs(depth);
  command->add_option("--focus-setting", o->focus_setting, "Which of the camera's focus settings")
      ->needs(camera);
  command
      ->add_option("--edge-step", o->edge_step,
                   "An edge is where neighbours' depths differ by more than this share")
      ->needs(depth);
  command->add_option(
      "--windows", o->windows,
      "Where data windows differ: union, 0 where a picture has nothing, or overlap");
  auto* crop = command->add_option("--crop", o->crop,
                                   "Only this part, 320x200+100+50, of the display window");
  command->add_option("--mask", o->mask,
                      "PSNR and RMS where this picture's first channel is above a half; SSIM and "
                      "energy with all outside it alike");
  depth->excludes(crop);
  auto* sheet = command->add_option("--sheet", o->sheet,
                                    "Write A, B and their difference side by side, PNG or JPEG");
  command->add_option("--amplify", o->amplify, "The sheet's difference is this many times as dark")
      ->needs(sheet);
  command->add_flag("--json", o->json, "Print one JSON object");
  command->footer(
      "The edge band: pixels within the CoC radius (of the more blurred surface) plus 1 px of a "
      "depth edge.\n"
      "Depth is planar, in metres: 'defray render' reads other kinds, this command does not.\n"
      "Examples:\n"
      "  defray compare out.exr truth.exr --min-psnr 35 --sheet difference.png\n"
      "  defray compare out.exr truth.exr --depth pinhole.exr --camera camera.json");
  return [o] { return run(*o); };
}

}  // namespace defray::cli
