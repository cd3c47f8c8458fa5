#include "base/input_file.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <iterator>

#include "base/error.h"

namespace defray {

void check_readable(const std::string& path) {
  std::error_code unknown;
  if (std::filesystem::is_directory(path, unknown)) {
    fail(ErrorKind::input, "{}: is a folder, not a file", path);
  }
  if (access(path.c_str(), R_OK) == 0) return;
  const bool is_missing = errno == ENOENT || errno == ENOTDIR;
  fail(ErrorKind::input, "{}: {}", path,
       is_missing ? "no such file" : fmt::format("cannot be read: {}", std::strerror(errno)));
}

std::ifstream open_input(const std::string& path) {
  check_readable(path);
  std::ifstream file(path, std::ios::binary);
  if (!file) fail(ErrorKind::input, "{}: cannot be read: {}", path, std::strerror(errno));
  return file;
}

std::string text_of(const std::string& path) {
  std::ifstream file = open_input(path);
  std::string text{std::istreambuf_iterator<char>(file), {}};
  if (!file) fail(ErrorKind::input, "{}: cannot be read", path);
  return text;
}

}  // namespace defray
