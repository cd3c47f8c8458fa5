#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "base/error.h"
#include "base/text.h"
#include "splat/cloud_columns.h"

namespace defray {

PointCloud read_point_cloud(const std::string& path) {
  const std::string extension = lower_extension(path);
  const bool is_ply = extension == ".ply";
  if (!is_ply && extension != ".xyz" && extension != ".txt" && extension != ".csv" &&
      extension != ".pts") {
    fail(ErrorKind::input, "{}: point clouds are .ply, .xyz, .txt, .csv or .pts", path);
  }
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) {
    fail(ErrorKind::input, "{}: is a folder", path);
  }
  std::ifstream file(path, std::ios::binary);
  if (!file) fail(ErrorKind::input, "{}: cannot be read: {}", path, std::strerror(errno));
  const std::uint64_t bytes = std::filesystem::file_size(path, ignored);
  if (bytes == 0) fail(ErrorKind::input, "{}: is empty", path);
  return is_ply ? read_ply(file, bytes, path) : read_text_cloud(file, bytes, path);
}

}  // namespace defray
