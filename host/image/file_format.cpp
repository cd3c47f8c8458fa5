#include "image/file_format.h"

#include <array>
#include <utility>

#include "base/error.h"
#include "base/input_file.h"
#include "base/text.h"
#include "image/ldr.h"

namespace defray {
namespace {

struct PictureFormat {
  std::string_view start;
  const char* extension;
  const char* name;
  bool is_encoded;  ///< sRGB, as is_ldr_path() says of names.
};
constexpr PictureFormat picture_formats[] = {{"\x76\x2f\x31\x01", ".exr", "an OpenEXR", false},
                                             {"\x89PNG", ".png", "a PNG", true},
                                             {"\xff\xd8\xff", ".jpg", "a JPEG", true},
                                             {"II*", ".tif", "a TIFF", false},
                                             {"MM", ".tif", "a TIFF", false},
                                             {"#?", ".hdr", "a Radiance HDR", false}};

const PictureFormat* picture_format_of(std::string_view bytes) {
  for (const PictureFormat& format : picture_formats) {
    if (bytes.starts_with(format.start)) return &format;
  }
  return nullptr;
}

bool is_linear_path(const std::string& path) {
  const std::string extension = lower_extension(path);
  return extension == ".exr" || extension == ".tif" || extension == ".tiff" || extension == ".hdr";
}

}  // namespace

std::string extension_of_content(std::string_view bytes) {
  const PictureFormat* format = picture_format_of(bytes);
  return format ? format->extension : "";
}

void check_format_is_as_named(const std::string& path) {
  std::array<char, 4> start{};
  std::ifstream stream = open_input(path);
  stream.read(start.data(), start.size());
  const PictureFormat* format =
      picture_format_of({start.data(), static_cast<std::size_t>(stream.gcount())});
  if (!format) return;
  const bool is_wrong = format->is_encoded ? is_linear_path(path) : is_ldr_path(path);
  if (!is_wrong) return;
  fail(ErrorKind::input, "{}: is {} file by its content: name it {}", path, format->name,
       format->extension);
}

}  // namespace defray
