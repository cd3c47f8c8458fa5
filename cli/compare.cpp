// defray compare: how far two pictures are apart. defray sheet: pictures side by side.
#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>

#include "commands.h"
#include "display.h"
#include "error.h"
#include "image/channels.h"
#include "image/ldr.h"
#include "image/safe_output.h"
#include "metrics.h"
#include "text.h"

namespace defray::cli {
namespace {

struct Picture {
  std::vector<Plane> planes;
  Window data;
};

Picture read_picture(const std::string& path) {
  const ImageFile file = ImageFile::read(path);
  const ColourChoice choice = choose_colour(path, file.parts(), {});
  Picture picture{{}, file.parts()[static_cast<std::size_t>(choice.part)].data};
  for (const int c : choice.channels) picture.planes.push_back(file.plane(choice.part, c));
  return picture;
}

void require_same_size(const std::string& a_path, const Picture& a, const std::string& b_path,
                       const Picture& b) {
  if (a.data != b.data) {
    fail(ExitCode::input, "{} has data window {}, {} has {}: both must be the same", a_path,
         to_string(a.data), b_path, to_string(b.data));
  }
}

struct CompareOptions {
  std::string a, b;
  bool json = false;
  std::optional<double> min_psnr;
};

int run_compare(const CompareOptions& o) {
  if (o.min_psnr && std::isnan(*o.min_psnr)) fail(ExitCode::usage, "--min-psnr is not a number");
  const Picture a = read_picture(o.a), b = read_picture(o.b);
  require_same_size(o.a, a, o.b, b);
  const Comparison c = compare(a.planes, b.planes, a.data.width);
  if (o.json) {
    const nlohmann::ordered_json line = {{"equal", c.worst == 0},
                                         {"psnr_srgb_db", c.psnr_srgb_db},
                                         {"psnr_linear_db", c.psnr_linear_db},
                                         {"rms", c.rms},
                                         {"worst", c.worst},
                                         {"worst_x", c.worst_x},
                                         {"worst_y", c.worst_y}};
    fmt::print("{}\n", line.dump());
  } else {
    fmt::print("PSNR {:.2f} dB (sRGB-encoded), {:.2f} dB (linear), both clipped to 0...1\n",
               c.psnr_srgb_db, c.psnr_linear_db);
    fmt::print("RMS error {:.6g}, worst {:.6g} at pixel ({}, {}) (linear, not clipped)\n", c.rms,
               c.worst, c.worst_x, c.worst_y);
  }
  // A NaN is never good enough.
  const bool missed = o.min_psnr && !(c.psnr_srgb_db >= *o.min_psnr);
  return static_cast<int>(missed ? ExitCode::failed : ExitCode::ok);
}

struct SheetOptions {
  std::vector<std::string> pictures, captions;
  std::string output;
};

int run_sheet(const SheetOptions& o) {
  if (!o.captions.empty() && o.captions.size() != o.pictures.size()) {
    fail(ExitCode::usage, "--captions names {} pictures, there are {}", o.captions.size(),
         o.pictures.size());
  }
  if (!is_ldr_path(o.output)) fail(ExitCode::usage, "{}: a sheet is PNG or JPEG", o.output);
  for (const std::string& picture : o.pictures) {
    std::error_code ignored;
    if (std::filesystem::equivalent(picture, o.output, ignored)) {
      fail(ExitCode::usage, "{}: is input and output at once; write to another file", o.output);
    }
  }
  check_can_write(o.output);
  std::vector<Panel> panels;
  Window size;
  Picture first;
  for (std::size_t i = 0; i < o.pictures.size(); ++i) {
    Picture picture = read_picture(o.pictures[i]);
    if (i == 0) first.data = size = picture.data;
    require_same_size(o.pictures[0], first, o.pictures[i], picture);
    panels.push_back(
        {o.captions.empty() ? o.pictures[i] : o.captions[i], std::move(picture.planes)});
  }
  write_sheet(o.output, panels, size.width, size.height);
  fmt::print("{}\n", o.output);
  return 0;
}

}  // namespace

Run add_compare(CLI::App& app) {
  CLI::App* command = app.add_subcommand("compare", "Compare two pictures: PSNR and worst pixel");
  auto o = std::make_shared<CompareOptions>();
  command->add_option("a", o->a, "Picture")->required();
  command->add_option("b", o->b, "Picture of the same size, for instance the truth")->required();
  command->add_option("--min-psnr", o->min_psnr, "Exit with 1 below this PSNR, dB, sRGB-encoded");
  command->add_flag("--json", o->json, "Print one JSON object");
  command->footer("Example: defray compare out.exr truth.exr --min-psnr 35");
  return [o] { return run_compare(*o); };
}

Run add_sheet(CLI::App& app) {
  CLI::App* command = app.add_subcommand("sheet", "Put pictures of one size side by side");
  auto o = std::make_shared<SheetOptions>();
  command->add_option("pictures", o->pictures, "Pictures, left to right")->required();
  command->add_option("-o,--output", o->output, "PNG or JPEG")->required();
  command->add_option("--captions", o->captions, "A caption for each picture, comma-separated")
      ->delimiter(',');
  command->footer(
      "Example: defray sheet in.exr out.exr truth.exr -o sheet.png --captions "
      "pinhole,result,truth");
  return [o] { return run_sheet(*o); };
}

}  // namespace defray::cli
