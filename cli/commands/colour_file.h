#pragma once
// What compare and sheet share: pictures of one size.
#include <string>
#include <vector>

#include "image/image_file.h"

namespace defray::cli {

/// The colour of a file: R G B, and A where it has it.
struct ColourFile {
  std::string path;
  std::vector<Plane> planes;
  Window data;
};

/// Throws Error(input) as ImageFile::read and choose_colour do.
ColourFile read_colour_file(const std::string& path);

/// Throws Error(input) unless the data windows are the same.
void require_same_size(const ColourFile& a, const ColourFile& b);

/// Before the work: throws Error(usage) unless `path` is a PNG or JPEG and none of the inputs,
/// Error(output) unless it can be written.
void check_sheet(const std::string& path, const std::vector<std::string>& inputs);

}  // namespace defray::cli
