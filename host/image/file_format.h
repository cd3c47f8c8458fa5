#pragma once
// Formats of pictures by what files hold, not by what they are called.
#include <string>
#include <string_view>

namespace defray {

/// The extension of a picture that begins with these bytes, ".exr"; empty for what is none that is
/// read.
std::string extension_of_content(std::string_view bytes);

/// Throws Error(input) where a picture's name says PNG or JPEG, whose values are sRGB-encoded, and
/// its content is one of the other formats, or the other way round.
void check_format_is_as_named(const std::string& path);

}  // namespace defray
