#include "image/depth_plane.h"

#include <optional>

#include "base/error.h"
#include "image/output.h"
#include "image/safe_output.h"

namespace defray {

DepthPlane read_depth(const ImageFile& colour_file, const ColourChoice& colour,
                      const ChannelRequest& request, const std::string& depth_path) {
  std::optional<ImageFile> other;
  if (!depth_path.empty()) other = ImageFile::read(depth_path, Content::data);
  const ImageFile& file = other ? *other : colour_file;
  ColourChoice beside = colour;
  if (other && !is_same_file(depth_path, colour_file.path())) {
    beside.channels.clear();  // numbers of the colour's file
  }
  const ChannelName name = choose_depth(file.path(), file.parts(), request, beside);
  const std::string channel = describe(name, file.parts());
  const PartInfo& part = file.parts()[static_cast<std::size_t>(name.part)];
  const PartInfo& beside_part = colour_file.parts()[static_cast<std::size_t>(colour.part)];
  DepthPlane depth{file.plane(name.part, name.channel), channel, part.integer_bits, is_mist(name)};
  if (part.data == beside_part.data) return depth;
  const std::string windows =
      fmt::format("{}: depth {} has data window {}, display window {}, colour in {} has {}, {}",
                  file.path(), channel, to_string(part.data), to_string(part.display),
                  colour_file.path(), to_string(beside_part.data), to_string(beside_part.display));
  if (part.display != beside_part.display) {
    fail(ErrorKind::input, "{}: depth of another picture?", windows);
  }
  if (intersection(part.data, beside_part.data) != beside_part.data) {
    fail(ErrorKind::input,
         "{}: depth must reach as far; if there is nothing but background outside, oiiotool "
         "--crop {} fills it with 0, which says so",
         windows, to_string(beside_part.data));
  }
  depth.values = to_display_window({depth.values}, part.data, beside_part.data).front();
  return depth;
}

}  // namespace defray
