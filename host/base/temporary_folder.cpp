#include "base/temporary_folder.h"

#include <stdlib.h>
#include <unistd.h>

#include <charconv>
#include <filesystem>
#include <system_error>

#include "base/process.h"

namespace defray {
namespace {

namespace fs = std::filesystem;

/// Folders of this name whose processes were killed.
void remove_left_behind(const std::string& name) {
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(fs::temp_directory_path(), ignored)) {
    const std::string file = entry.path().filename().string();
    const std::string start = name + "-";
    if (!file.starts_with(start)) continue;
    long pid = 0;
    const auto [end, error] =
        std::from_chars(file.data() + start.size(), file.data() + file.size(), pid);
    const bool is_ours = error == std::errc() && end != file.data() + file.size() && *end == '-';
    if (is_ours && !is_running(pid)) fs::remove_all(entry.path(), ignored);
  }
}

}  // namespace

TemporaryFolder::TemporaryFolder(const std::string& name)
    : path_((fs::temp_directory_path() / (name + "-" + std::to_string(getpid()) + "-XXXXXX"))
                .string()) {
  remove_left_behind(name);
  if (!mkdtemp(path_.data())) path_.clear();
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  if (!path_.empty()) fs::remove_all(path_, ignored);
}

}  // namespace defray
