#pragma once
// What an ImageFile holds, for its own sources and tests alone: OpenImageIO shows.
#include <OpenImageIO/imageio.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "image/image_file.h"

namespace defray {

struct ImageFile::Part {
  OIIO::ImageSpec spec;
  std::vector<std::byte> pixels;
};

/// The first number of metadata of any type; none in a ratio to 0, EXIF's "unknown".
std::optional<double> number_of(const OIIO::ParamValue& value);

/// First line of an OpenImageIO message, which may repeat itself over several.
inline std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

}  // namespace defray
