#pragma once
// What an ImageFile holds, for its own sources alone: OpenImageIO shows.
#include <OpenImageIO/imageio.h>

#include <cstddef>
#include <string>
#include <vector>

#include "image/image_file.h"

namespace defray {

struct ImageFile::Part {
  OIIO::ImageSpec spec;
  std::vector<std::byte> pixels;
};

/// First line of an OpenImageIO message, which may repeat itself over several.
inline std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

}  // namespace defray
