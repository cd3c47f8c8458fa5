#pragma once
// Display-encoded pictures (PNG, JPEG) through OpenCV: sRGB in the file, linear in memory.
#include <string>
#include <vector>

#include "base/plane.h"
#include "base/srgb.h"

namespace defray {

/// True for .png, .jpg and .jpeg.
bool is_ldr_path(const std::string& path);

struct LdrPicture {
  int width = 0, height = 0;
  std::vector<std::string> channels;  ///< Y of a grey file, else R G B, and A where it has it.
  std::vector<Plane> planes;          ///< Linear; alpha premultiplied.
  int bits = 8;                       ///< A channel, in the file: 8 or 16.
};

/// What a file's numbers are: pictures are decoded from sRGB, data (depth) is taken as stored.
enum class Content { picture, data };

/// Throws Error(input) on a file that OpenCV cannot decode.
LdrPicture read_ldr(const std::string& path, Content content = Content::picture);

/// Writes an OpenCV image of 8 or 16 bits (cv::Mat, hidden here to keep OpenCV out of this header).
void write_encoded(const std::string& path, const void* mat);

/// Writes grey, RGB or RGBA planes with the picture's bits a channel; values outside 0...1 are
/// clipped, as the formats demand. JPEG leaves alpha out. Throws Error(output).
void write_ldr(const std::string& path, const LdrPicture& picture);

}  // namespace defray
