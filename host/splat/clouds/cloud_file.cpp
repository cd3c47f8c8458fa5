#include <filesystem>

#include "base/error.h"
#include "base/input_file.h"
#include "base/text.h"
#include "splat/clouds/cloud_columns.h"

namespace defray {

bool is_cloud_name(const std::string& path) {
  const std::string extension = lower_extension(path);
  return extension == ".ply" || extension == ".xyz" || extension == ".txt" || extension == ".csv" ||
         extension == ".pts";
}

PointCloud read_point_cloud(const std::string& path) {
  const bool is_ply = lower_extension(path) == ".ply";
  if (!is_cloud_name(path)) {
    fail(ErrorKind::input, "{}: point clouds are .ply, .xyz, .txt, .csv or .pts", path);
  }
  std::ifstream file = open_input(path);
  std::error_code ignored;
  const std::uint64_t bytes = std::filesystem::file_size(path, ignored);
  if (bytes == 0) fail(ErrorKind::input, "{}: is empty", path);
  return is_ply ? read_ply(file, bytes, path) : read_text_cloud(file, bytes, path);
}

}  // namespace defray
