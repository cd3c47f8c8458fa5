#include "tuning/tuning_file.h"

#include <fcntl.h>
#include <fmt/chrono.h>
#include <sys/file.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/text.h"
#include "image/safe_output.h"
#include "opencl/kernel_source.h"
#include "opencl/launch_table.h"

namespace defray::tuning {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::uintmax_t largest_file = 16u << 20;  // ours stay below 2 MB
constexpr const char* schema_version = "1.0.0";
constexpr const char* do_anew = "'defray tune' makes it anew";

/// FNV-1a.
std::string hash_of(const std::string& text) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  return fmt::format("{:016x}", hash);
}

/// While it lives no other process changes the file.
class FileLock {
 public:
  explicit FileLock(const std::string& path)
      : file_(open((path + ".lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, S_IRUSR | S_IWUSR)) {
    if (file_ < 0) fail(ErrorKind::output, "{}.lock cannot be written", path);
    flock(file_, LOCK_EX);
  }
  ~FileLock() { close(file_); }
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;

 private:
  int file_;
};

Json to_json(const Key& key) {
  return {{"device", key.device},
          {"platform", key.platform},
          {"driver", key.driver},
          {"kernels", key.kernels}};
}

const char* word_of(Validity validity) {
  switch (validity) {
    case Validity::correct: return "correct";
    case Validity::correctness: return "correctness";
    case Validity::runtime: break;
  }
  return "runtime";
}

/// Throws Error(internal) on another word.
Validity validity_of(const std::string& word) {
  for (const Validity v : {Validity::correct, Validity::correctness, Validity::runtime}) {
    if (word == word_of(v)) return v;
  }
  fail(ErrorKind::internal, "invalidity is '{}'", word);
}

Json to_json(const Result& r) {
  Json json = {
      {"timestamp", fmt::format("{:%Y-%m-%dT%H:%M:%SZ}",
                                fmt::gmtime(std::chrono::system_clock::to_time_t(
                                    std::chrono::system_clock::now())))},
      {"configuration",
       {{"kernel", r.place.kernel},
        {"frame_class", r.place.frame_class},
        {"picture", r.place.picture},
        {"work_group_x", r.shape.x},
        {"work_group_y", r.shape.y}}},
      {"objectives", {"time"}},
      {"times", {{"runtimes", r.run_ms}}},
      {"invalidity", word_of(r.validity)},
      {"correctness", r.validity == Validity::correct ? 1.0 : 0.0},
      {"measurements", Json::array()}};
  if (!r.run_ms.empty()) {
    json["measurements"].push_back(
        {{"name", "time"}, {"value", median_of(r.run_ms)}, {"unit", "ms"}});
  }
  return json;
}

/// Throws on whatever is not as to_json writes it, and not possible here.
Result result_of(const Json& json, std::size_t most_items) {
  const Json& c = json.at("configuration");
  Result r{{c.at("frame_class"), c.at("picture"), c.at("kernel")},
           {c.at("work_group_x").get<std::size_t>(), c.at("work_group_y").get<std::size_t>()},
           validity_of(json.at("invalidity")),
           json.at("times").at("runtimes").get<std::vector<double>>()};
  launch_of(r.place.kernel);
  const bool is_possible = r.shape.x > 0 && r.shape.y > 0 && r.shape.x <= most_items &&
                           r.shape.y <= most_items / r.shape.x;
  if (!is_possible) fail(ErrorKind::internal, "work-group {}", to_string(r.shape));
  for (const double ms : r.run_ms) {
    if (!std::isfinite(ms) || ms <= 0) fail(ErrorKind::internal, "a runtime is {} ms", ms);
  }
  return r;
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

Key key_of(const DeviceProperties& device) {
  static const std::string kernels = hash_of(kernel_source({}, {}));
  return {device.name, device.platform, device.version, kernels};
}

std::string path_of(const Key& key) {
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
         ("tuning-" + name.substr(0, 60) + "-" +
          hash_of(key.device + "\n" + key.platform).substr(0, 8) + ".json");
}

Tuning read(const std::string& path, const Key& key, std::size_t most_items) {
  std::error_code error;
  if (path.empty() || !fs::exists(path, error)) return {};
  Tuning tuning;
  try {
    const Json json = json_of(path);
    if (const std::string other = difference(json.at("metadata"), key); !other.empty()) {
      tuning.notice = fmt::format("{}: is of another {}, so its work-groups are not used; {}", path,
                                  other == "kernels" ? "version of the kernels" : other, do_anew);
      return tuning;
    }
    for (const Json& one : json.at("results")) {
      tuning.results.push_back(result_of(one, most_items));
    }
  } catch (const std::exception& e) {
    std::string what = e.what();
    tuning = {{}, fmt::format("{}: is damaged and not used ({}); {}", path, what, do_anew)};
  }
  return tuning;
}

std::string to_text(const Key& key, const std::vector<Result>& results) {
  Json json = {{"schema_version", schema_version},
               {"metadata", to_json(key)},
               {"results", Json::array()}};
  for (const Result& r : results) json["results"].push_back(to_json(r));
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::vector<Result> add(const std::string& path, const Key& key, std::size_t most_items,
                        const std::vector<Result>& results) {
  create_folder(fs::path(path).parent_path());
  const FileLock lock(path);
  std::vector<Result> all = read(path, key, most_items).results;
  merge(all, results);
  write_text(path, to_text(key, all));
  return all;
}

}  // namespace defray::tuning
