#pragma once
// Files that are read.
#include <fstream>
#include <string>

namespace defray {

/// Throws Error(input): there is no such file, it is a folder, or it may not be read.
void check_readable(const std::string& path);

/// A file, at its beginning. Throws Error(input), as check_readable() does.
std::ifstream open_input(const std::string& path);

/// All that such a file holds.
std::string text_of(const std::string& path);

}  // namespace defray
