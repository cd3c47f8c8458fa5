#include "tuning/tuning_file.h"

#include <fmt/chrono.h>

#include <chrono>
#include <cmath>

#include "base/error.h"
#include "image/safe_output.h"
#include "opencl/launch_table.h"

namespace defray::tuning {
namespace {

constexpr const char* schema_version = "1.0.0";

const char* word_of(Validity validity) {
  switch (validity) {
    case Validity::correct:
      return "correct";
    case Validity::correctness:
      return "correctness";
    case Validity::runtime:
      break;
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
  Json json = {{"timestamp", fmt::format("{:%Y-%m-%dT%H:%M:%SZ}",
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
    json["measurements"].push_back({{"name", "time"}, {"value", time_of(r)}, {"unit", "ms"}});
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

}  // namespace

std::string path_of(const Key& key) { return device_path("tuning", key); }

Tuning read(const std::string& path, const Key& key, std::size_t most_items) {
  Tuning tuning;
  tuning.notice = read_device_file(path, key, "'defray tune' makes it anew", [&](const Json& json) {
    for (const Json& one : json.at("results")) {
      tuning.results.push_back(result_of(one, most_items));
    }
  });
  if (!tuning.notice.empty()) tuning.results.clear();
  return tuning;
}

std::string to_text(const Key& key, const std::vector<Result>& results) {
  Json json = {
      {"schema_version", schema_version}, {"metadata", to_json(key)}, {"results", Json::array()}};
  for (const Result& r : results) json["results"].push_back(to_json(r));
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::vector<Result> add(const std::string& path, const Key& key, std::size_t most_items,
                        const std::vector<Result>& results) {
  const DeviceFileLock lock(path);
  std::vector<Result> all = read(path, key, most_items).results;
  merge(all, results);
  write_text(path, to_text(key, all));
  return all;
}

}  // namespace defray::tuning
