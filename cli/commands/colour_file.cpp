#include "commands/colour_file.h"

#include <filesystem>

#include "base/error.h"
#include "image/channels.h"
#include "image/ldr.h"
#include "image/safe_output.h"

namespace defray::cli {

ColourFile read_colour_file(const std::string& path) {
  const ImageFile file = ImageFile::read(path);
  const ColourChoice choice = choose_colour(path, file.parts(), {});
  ColourFile colour{path, {}, file.parts()[static_cast<std::size_t>(choice.part)].data};
  for (const int c : choice.channels) colour.planes.push_back(file.plane(choice.part, c));
  return colour;
}

void require_same_size(const ColourFile& a, const ColourFile& b) {
  if (a.data != b.data) {
    fail(ErrorKind::input, "{} has data window {}, {} has {}: both must be the same", a.path,
         to_string(a.data), b.path, to_string(b.data));
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
