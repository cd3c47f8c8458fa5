#include "commands/cloud_info.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/text.h"
#include "defray/splat.h"
#include "options/shell_quoted.h"
#include "splat/view.h"

namespace defray::cli {
namespace {

/// Of the points that have a place, scene units.
struct Bounds {
  std::array<double, 3> least, most;

  explicit Bounds(const PointCloud& cloud) {
    least.fill(INFINITY);
    most.fill(-INFINITY);
    for (const auto& place : cloud.positions) {
      if (!std::isfinite(place[0] + place[1] + place[2])) continue;
      for (std::size_t i = 0; i < 3; ++i) {
        const double at = cloud.origin[i] + static_cast<double>(place[i]);
        least[i] = std::min(least[i], at);
        most[i] = std::max(most[i], at);
      }
    }
  }
  double radius() const {
    return std::hypot(most[0] - least[0], most[1] - least[1], most[2] - least[2]) / 2;
  }
};

/// The whole cloud, its middle in focus, its near and far ends with circles of a hundredth of the
/// width; in a unit in which the lens is not in the midst of it.
std::string command_for(const std::string& path, double radius) {
  const Lens lens;
  const double distance = framing_distance(radius, lens, {});
  const double focal_m = lens.focal_length_mm / 1000;
  double metres = 1;
  while (radius > 0 && distance * metres < 10 * focal_m) metres *= 10;
  std::string command = "defray splat " + shell_quoted(path) + " -o out.exr";
  if (metres > 1) command += fmt::format(" --unit {:g}", metres);
  constexpr double share = 0.01;
  const double z = distance * metres, r = radius * metres;
  const double aperture_mm = 2 * share * lens.sensor_width_mm * z * (z + r) / (focal_m * r);
  return command + (radius > 0 ? fmt::format(" --aperture-diameter {:.0f}", std::ceil(aperture_mm))
                               : std::string(" --fstop 2.8"));
}

std::vector<std::string> given_of(const PointCloud& cloud) {
  std::vector<std::string> given;
  if (!cloud.normals.empty()) given.emplace_back("normals");
  if (!cloud.colours.empty()) given.emplace_back("colours");
  if (!cloud.alpha.empty()) given.emplace_back("alpha");
  if (!cloud.radii.empty()) given.emplace_back("radii");
  return given;
}

}  // namespace

void print_cloud_info(const std::string& path, bool json) {
  const PointCloud cloud = read_point_cloud(path);
  const Bounds bounds(cloud);
  const std::vector<std::string> given = given_of(cloud);
  const std::string command = command_for(path, bounds.radius());
  if (json) {
    const nlohmann::ordered_json line{{"file", path},          {"points", cloud.positions.size()},
                                      {"least", bounds.least}, {"most", bounds.most},
                                      {"given", given},        {"notes", cloud.notes},
                                      {"command", command}};
    // Names come from files: bytes that are no UTF-8 are replaced, not fatal.
    fmt::print("{}\n", line.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
    return;
  }
  fmt::print("{}\n  points: {}\n", path, cloud.positions.size());
  for (std::size_t i = 0; i < 3; ++i) {
    fmt::print("  {} {:.6g} to {:.6g}\n", "xyz"[i], bounds.least[i], bounds.most[i]);
  }
  fmt::print("  given: places{}\n", given.empty() ? "" : ", " + join(given, ", "));
  for (const std::string& note : cloud.notes) fmt::print("  {}\n", note);
  fmt::print("try:\n  {}\n", command);
}

}  // namespace defray::cli
