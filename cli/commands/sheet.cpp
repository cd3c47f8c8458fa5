// defray sheet: pictures side by side.
#include <fmt/format.h>

#include <cmath>

#include "base/error.h"
#include "commands.h"
#include "commands/colour_file.h"
#include "image/display.h"
#include "options/option_value.h"

namespace defray::cli {
namespace {

struct SheetOptions {
  std::vector<std::string> pictures, captions;
  std::string output, windows = "union", crop;
  int zoom = 1;
  double exposure = 0;
  bool quiet = false;
};

/// Each pixel so many times across and down.
Plane zoomed(const Plane& plane, int width, int times) {
  const auto w = static_cast<std::size_t>(width), n = static_cast<std::size_t>(times);
  const std::size_t height = plane.size() / w;
  Plane out(plane.size() * n * n);
  for (std::size_t y = 0; y < height * n; ++y) {
    for (std::size_t x = 0; x < w * n; ++x) out[y * w * n + x] = plane[y / n * w + x / n];
  }
  return out;
}

void check(const SheetOptions& o) {
  if (!o.captions.empty() && o.captions.size() != o.pictures.size()) {
    fail(ErrorKind::usage, "--captions names {} pictures, there are {}", o.captions.size(),
         o.pictures.size());
  }
  if (o.zoom < 1 || o.zoom > 64) {
    fail(ErrorKind::usage, "--zoom is {}: allowed are 1 to 64", o.zoom);
  }
  if (!(std::fabs(o.exposure) <= 64)) {
    fail(ErrorKind::usage, "--exposure is {} stops: allowed are -64 to 64", o.exposure);
  }
  check_sheet(o.output, o.pictures);
}

int run(const SheetOptions& o) {
  check(o);
  Region region;
  set_region(region, o.windows, o.crop);
  std::vector<ColourFile> files;
  for (const std::string& path : o.pictures) files.push_back(read_colour_file(path));
  std::vector<ColourFile*> all;
  for (ColourFile& file : files) all.push_back(&file);
  bring_together(all, region);
  const Window data = files.front().data;
  const auto factor = static_cast<float>(std::exp2(o.exposure));
  std::vector<SheetPanel> panels;
  for (std::size_t i = 0; i < files.size(); ++i) {
    SheetPanel panel{o.captions.empty() ? o.pictures[i] : o.captions[i], {}};
    for (const Plane& plane : files[i].planes) {
      panel.planes.push_back(zoomed(plane, data.width, o.zoom));
      for (float& value : panel.planes.back()) value *= factor;
    }
    panels.push_back(std::move(panel));
  }
  write_sheet(o.output, panels, data.width * o.zoom, data.height * o.zoom);
  if (!o.quiet) fmt::print("{}\n", o.output);
  return 0;
}

}  // namespace

Run add_sheet(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("sheet", "Put pictures of one display window side by side");
  auto o = std::make_shared<SheetOptions>();
  command->add_option("pictures", o->pictures, "Pictures, left to right")->required();
  command->add_option("-o,--output", o->output, "PNG or JPEG")->required();
  command->add_option("--captions", o->captions, "A caption for each picture, comma-separated")
      ->delimiter(',');
  command->add_option(
      "--windows", o->windows,
      "Where data windows differ: union, 0 where a picture has nothing, or overlap");
  command->add_option("--crop", o->crop, "Only this part, 320x200+100+50, of the display window");
  command->add_option("--zoom", o->zoom, "Each pixel so many times as large, 1 to 64");
  command->add_option("--exposure", o->exposure, "Brighter by so many stops");
  command->add_flag("-q,--quiet", o->quiet, quiet_help);
  command->footer(
      "Example: defray sheet in.exr out.exr truth.exr -o sheet.png --captions "
      "pinhole,result,truth");
  return [o] { return run(*o); };
}

}  // namespace defray::cli
