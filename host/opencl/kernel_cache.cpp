#include "opencl/kernel_cache.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <mutex>
#include <string>

#include "base/temporary_folder.h"

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

}  // namespace

void prepare_environment() {
  static std::once_flag once;
  std::call_once(once, [] {
    // PoCL sets this itself as it starts. A new variable moves all of them, under the eyes of
    // threads that ask for one (readers of pictures do); one that is there already moves nothing.
    setenv("HWLOC_PLUGINS_PATH", "/dev/null", 0);
    if (is_writable(pocl_cache_folder())) return;
    static const TemporaryFolder folder("defray-kcache");
    if (!folder.path().empty()) setenv("POCL_CACHE_DIR", folder.path().c_str(), 1);
  });
}

KernelCacheLock::KernelCacheLock()
    : file_(open((pocl_cache_folder() / "defray.lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC,
                 S_IRUSR | S_IWUSR)) {
  if (file_ >= 0) flock(file_, LOCK_EX);
}

KernelCacheLock::~KernelCacheLock() {
  if (file_ >= 0) close(file_);  // which unlocks it
}

}  // namespace defray
