#include "image/depth_plane.h"

#include <optional>

#include "base/error.h"
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
  const Window& data = file.parts()[static_cast<std::size_t>(name.part)].data;
  const Window& colour_data = colour_file.parts()[static_cast<std::size_t>(colour.part)].data;
  if (data != colour_data) {
    fail(ErrorKind::input,
         "{}: depth {} has data window {}, colour in {} has {}; both must be the same", file.path(),
         channel, to_string(data), colour_file.path(), to_string(colour_data));
  }
  return {file.plane(name.part, name.channel), channel,
          file.parts()[static_cast<std::size_t>(name.part)].integer_bits, is_mist(name)};
}

}  // namespace defray
