// defray sheet: pictures side by side.
#include <fmt/format.h>

#include "base/error.h"
#include "commands.h"
#include "commands/colour_file.h"
#include "image/display.h"

namespace defray::cli {
namespace {

struct SheetOptions {
  std::vector<std::string> pictures, captions;
  std::string output;
};

int run(const SheetOptions& o) {
  if (!o.captions.empty() && o.captions.size() != o.pictures.size()) {
    fail(ErrorKind::usage, "--captions names {} pictures, there are {}", o.captions.size(),
         o.pictures.size());
  }
  check_sheet(o.output, o.pictures);
  std::vector<SheetPanel> panels;
  ColourFile first;
  for (std::size_t i = 0; i < o.pictures.size(); ++i) {
    ColourFile picture = read_colour_file(o.pictures[i]);
    if (i == 0) first = {picture.path, {}, picture.data};
    require_same_size(first, picture);
    panels.push_back(
        {o.captions.empty() ? o.pictures[i] : o.captions[i], std::move(picture.planes)});
  }
  write_sheet(o.output, panels, first.data.width, first.data.height);
  fmt::print("{}\n", o.output);
  return 0;
}

}  // namespace

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
  return [o] { return run(*o); };
}

}  // namespace defray::cli
