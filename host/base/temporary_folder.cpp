#include "base/temporary_folder.h"

#include <fcntl.h>
#include <stdlib.h>
#include <unistd.h>

#include <array>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <system_error>

#include "base/process.h"
#include "base/raw_folder.h"
#include "base/stop_threads.h"

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

/// Folders that there are, for the signal handler: each empty, or a complete path.
constexpr std::size_t most_folders = 8;
std::array<std::array<char, 4096>, most_folders> folders{};

void remember(const std::string& path) {
  for (auto& folder : folders) {
    if (folder[0] != '\0' || path.size() >= folder.size()) continue;
    std::memcpy(folder.data() + 1, path.c_str() + 1, path.size());
    folder[0] = path[0];  // last: the handler never sees half a name
    return;
  }
}

void forget(const std::string& path) {
  for (auto& folder : folders) {
    if (path == folder.data()) folder[0] = '\0';
  }
}

/// Removes what is in an open folder.
void empty_folder(int folder, int depth) noexcept {
  constexpr int deepest = 8;
  for_each_name(folder, [&](const char* name) {
    if (unlinkat(folder, name, 0) == 0 || depth == deepest) return;
    const int inner = openat(folder, name, O_RDONLY | O_DIRECTORY | O_NOFOLLOW);
    if (inner < 0) return;
    empty_folder(inner, depth + 1);
    close(inner);
    unlinkat(folder, name, AT_REMOVEDIR);
  });
}

}  // namespace

void remove_temporary_folders_on_signal() noexcept {
  for (const auto& path : folders) {
    if (path[0] == '\0') continue;
    stop_other_threads();
    const int folder = open(path.data(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW);
    if (folder < 0) continue;
    empty_folder(folder, 0);
    close(folder);
    rmdir(path.data());
  }
}

TemporaryFolder::TemporaryFolder(const std::string& name)
    : path_((fs::temp_directory_path() / (name + "-" + std::to_string(getpid()) + "-XXXXXX"))
                .string()) {
  remove_left_behind(name);
  if (!mkdtemp(path_.data())) path_.clear();
  if (!path_.empty()) remember(path_);
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  if (path_.empty()) return;
  fs::remove_all(path_, ignored);
  forget(path_);
}

}  // namespace defray
