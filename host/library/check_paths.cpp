#include "library/check_paths.h"

#include <filesystem>
#include <utility>

#include "base/error.h"
#include "image/output.h"
#include "image/safe_output.h"

namespace defray {

void check_paths(const FramePaths& paths, const std::vector<std::string>& also_read) {
  std::error_code ignored;
  std::vector<std::pair<const char*, std::string>> outputs = paths.data_outputs();
  outputs.insert(outputs.begin(), {"output", paths.output});
  for (const auto& [field_name, output] : outputs) {
    if (output.empty()) continue;
    std::vector<std::string> inputs = also_read;
    inputs.insert(inputs.end(), {paths.input, paths.depth});
    for (const std::string& input : inputs) {
      if (!input.empty() && std::filesystem::equivalent(input, output, ignored)) {
        fail(ErrorKind::usage, "{}: is input and output at once; write to another file", output);
      }
    }
  }
  for (const auto& [name, path] : outputs) {
    for (const auto& [other, other_path] : outputs) {
      if (&path == &other_path) break;
      if (!path.empty() && is_same_file(path, other_path)) {
        fail(ErrorKind::usage, "{}: {} and {} are the same file", path, field(other), field(name));
      }
    }
  }
}

void check_outputs(const FramePaths& paths, const RenderSettings& settings) {
  const auto check_place = [&](const std::string& path) {
    if (settings.make_folders) return check_can_make(path);
    check_can_write(path, field("make_folders") + " makes it");
  };
  check_output_format(paths.output);
  check_bits(paths.output, settings.bits);
  if (settings.grow) require_named("grow", *settings.grow, Grow::full);
  check_place(paths.output);
  std::vector<std::string> all{paths.output};
  for (const auto& [name, path] : paths.data_outputs()) {
    all.push_back(path);
    if (path.empty()) continue;
    check_plane_format(path, name);
    check_place(path);
  }
  check_compression(all, settings.compression);
}

void make_folders(const FramePaths& paths) {
  std::vector<std::string> all{paths.output};
  for (const auto& [name, path] : paths.data_outputs()) all.push_back(path);
  for (const std::string& path : all) {
    const std::filesystem::path folder = std::filesystem::path(path).parent_path();
    if (!folder.empty()) create_folder(folder.string());
  }
}

}  // namespace defray
