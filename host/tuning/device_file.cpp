#include "tuning/device_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "base/error.h"
#include "base/text.h"
#include "image/safe_output.h"
#include "opencl/kernel_source.h"

namespace defray::tuning {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t largest_file = 16u << 20;  // ours stay below 2 MB

/// FNV-1a.
std::string hash_of(const std::string& text) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  return fmt::format("{:016x}", hash);
}

/// Throws std::exception with what is wrong with it.
Json json_of(const std::string& path) {
  if (fs::file_size(path) > largest_file) {
    fail(ErrorKind::internal, "it has {} MiB", fs::file_size(path) >> 20);
  }
  std::ifstream file(path, std::ios::binary);
  return Json::parse(file);
}

/// What was written down of another driver, other kernels.
std::string difference(const Json& was, const Key& key) {
  const Json is = to_json(key);
  for (const auto& [name, value] : is.items()) {
    if (was.at(name) != value) return name;
  }
  return "";
}

}  // namespace

Json to_json(const Key& key) {
  return {{"device", key.device},
          {"platform", key.platform},
          {"driver", key.driver},
          {"kernels", key.kernels}};
}

Key key_of(const DeviceProperties& device) {
  static const std::string kernels = hash_of(kernel_source({}, {}));
  return {device.name, device.platform, device.version, kernels};
}

std::string device_path(const std::string& kind, const Key& key) {
  fs::path folder;
  const char* const cache = std::getenv("XDG_CACHE_HOME");
  const char* const home = std::getenv("HOME");
  if (cache && *cache) {
    folder = cache;
  } else if (home && *home) {
    folder = fs::path(home) / ".cache";
  } else {
    return "";
  }
  // The name for people, the hash for devices whose names differ in other characters only.
  std::string name;
  for (const char c : lower_case(key.device)) {
    const bool is_plain = (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9');
    if (is_plain || (!name.empty() && name.back() != '-')) name += is_plain ? c : '-';
  }
  return folder / "defray" /
         (kind + "-" + name.substr(0, 60) + "-" +
          hash_of(key.device + "\n" + key.platform).substr(0, 8) + ".json");
}

std::string read_device_file(const std::string& path, const Key& key, const std::string& otherwise,
                             const std::function<void(const Json&)>& take) {
  std::error_code error;
  if (path.empty() || !fs::exists(path, error)) return "";
  try {
    const Json json = json_of(path);
    if (const std::string other = difference(json.at("metadata"), key); !other.empty()) {
      return fmt::format("{}: is of another {} and not used; {}", path,
                         other == "kernels" ? "version of the kernels" : other, otherwise);
    }
    take(json);
  } catch (const std::exception& e) {
    std::string what = e.what();
    if (what.starts_with("[json")) what.erase(0, what.find("] ") + 2);  // the library's own name
    return fmt::format("{}: is damaged and not used ({}); {}", path, what, otherwise);
  }
  return "";
}

DeviceFileLock::DeviceFileLock(const std::string& path) {
  create_folder(fs::path(path).parent_path());
  file_ = open((path + ".lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, S_IRUSR | S_IWUSR);
  if (file_ < 0) fail(ErrorKind::output, "{}.lock cannot be written", path);
  flock(file_, LOCK_EX);
}

DeviceFileLock::~DeviceFileLock() { close(file_); }

}  // namespace defray::tuning
