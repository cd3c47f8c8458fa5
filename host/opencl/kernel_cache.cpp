#include "opencl/kernel_cache.h"

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <mutex>
#include <string>

namespace defray {
namespace {

namespace fs = std::filesystem;

std::string environment(const char* name) {
  const char* value = std::getenv(name);
  return value ? value : "";
}

/// Where PoCL would put its cache (its own order of precedence).
fs::path pocl_cache_folder() {
  if (const std::string own = environment("POCL_CACHE_DIR"); !own.empty()) return own;
  if (const std::string xdg = environment("XDG_CACHE_HOME"); !xdg.empty()) {
    return fs::path(xdg) / "pocl" / "kcache";
  }
  if (const std::string home = environment("HOME"); !home.empty()) {
    return fs::path(home) / ".cache" / "pocl" / "kcache";
  }
  return fs::path("/tmp/pocl/kcache");
}

bool is_writable(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) return false;
  std::string probe = (folder / "defray-probe-XXXXXX").string();
  const int file = mkstemp(probe.data());
  if (file < 0) return false;
  close(file);
  unlink(probe.c_str());
  return true;
}

/// A folder of this process's own, removed with it.
class PrivateFolder {
 public:
  PrivateFolder() : path_((fs::temp_directory_path() / "defray-kcache-XXXXXX").string()) {
    if (!mkdtemp(path_.data())) path_.clear();
  }
  ~PrivateFolder() {
    std::error_code ignored;
    if (!path_.empty()) fs::remove_all(path_, ignored);
  }
  PrivateFolder(const PrivateFolder&) = delete;
  PrivateFolder& operator=(const PrivateFolder&) = delete;
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

}  // namespace

void prepare_kernel_cache() {
  static std::once_flag once;
  std::call_once(once, [] {
    if (is_writable(pocl_cache_folder())) return;
    static const PrivateFolder folder;
    if (!folder.path().empty()) setenv("POCL_CACHE_DIR", folder.path().c_str(), 1);
  });
}

}  // namespace defray
