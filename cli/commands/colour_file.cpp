#include "commands/colour_file.h"

#include <filesystem>

#include "base/error.h"
#include "image/channels.h"
#include "image/ldr.h"
#include "image/output.h"
#include "image/safe_output.h"
#include "options/parse.h"
#include "options/words.h"

namespace defray::cli {

ColourFile read_colour_file(const std::string& path, const ChannelRequest& request) {
  const ImageFile file = ImageFile::read(path);
  const ColourChoice choice = choose_colour(path, file.parts(), request);
  const PartInfo& part = file.parts()[static_cast<std::size_t>(choice.part)];
  ColourFile colour{path, {}, part.data, part.display};
  for (const int c : choice.channels) colour.planes.push_back(file.plane(choice.part, c));
  colour.is_grey = colour.planes.size() <= 2;
  if (colour.is_grey) colour.planes.insert(colour.planes.begin(), 2, colour.planes.front());
  return colour;
}

void set_region(Region& region, const std::string& windows, const std::string& crop) {
  region.overlap_only = choice<bool>("--windows", windows, {{"union", false}, {"overlap", true}});
  if (!crop.empty()) region.crop = parse_window("--crop", crop, true);
}

void require_same_display(const ColourFile& a, const ColourFile& b) {
  if (a.display == b.display) return;
  fail(ErrorKind::input, "{} has display window {}, {} has {}: both must be the same", a.path,
       to_string(a.display), b.path, to_string(b.display));
}

namespace {

/// Of the pictures' windows, `all` what of their data is looked at. Throws Error(input) where it
/// reaches beyond them.
Window cropped(const Window& all, const Window& crop, const std::vector<ColourFile*>& pictures) {
  const Window& display = pictures.front()->display;
  Window allowed = display;
  for (const ColourFile* picture : pictures) allowed = hull(allowed, picture->data);
  const Window wanted{crop.x + display.x, crop.y + display.y, crop.width, crop.height};
  if (hull(allowed, wanted) != allowed) {
    fail(ErrorKind::input, "{}: --crop {} reaches outside: allowed is what lies in {}",
         pictures.front()->path, to_string(crop),
         to_string(
             Window{allowed.x - display.x, allowed.y - display.y, allowed.width, allowed.height}));
  }
  return intersection(all, wanted);
}

}  // namespace

void bring_together(const std::vector<ColourFile*>& pictures, const Region& region) {
  const ColourFile& first = *pictures.front();
  Window all = first.data;
  for (const ColourFile* picture : pictures) {
    require_same_display(first, *picture);
    all = region.overlap_only ? intersection(all, picture->data) : hull(all, picture->data);
  }
  if (region.crop) all = cropped(all, *region.crop, pictures);
  if (all.width <= 0 || all.height <= 0) {
    fail(ErrorKind::input, "{}: nothing is left to look at: {}", first.path,
         region.crop ? "--crop lies where no picture has data" : "the data windows do not overlap");
  }
  for (ColourFile* picture : pictures) {
    picture->planes = to_display_window(picture->planes, picture->data, all);
    picture->data = all;
  }
}

void check_sheet(const std::string& path, const std::vector<std::string>& inputs) {
  if (!is_ldr_path(path)) fail(ErrorKind::usage, "{}: a sheet is PNG or JPEG", path);
  for (const std::string& input : inputs) {
    std::error_code ignored;
    if (std::filesystem::equivalent(input, path, ignored)) {
      fail(ErrorKind::usage, "{}: is input and output at once; write to another file", path);
    }
  }
  check_can_write(path);
}

}  // namespace defray::cli
