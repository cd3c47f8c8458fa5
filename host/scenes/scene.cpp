#include "scenes/scene.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <thread>

#include "error.h"
#include "scenes/builtin.h"
#include "text.h"

namespace defray {
namespace {

constexpr double nothing_there = 1e10;  // as Cycles writes it

/// A small counter-based generator: independent of the order in which pixels are rendered.
class Random {
 public:
  Random(std::uint32_t x, std::uint32_t y, std::uint32_t seed)
      : state_((std::uint64_t{seed} << 40) ^ (std::uint64_t{y} << 20) ^ x) {}
  /// Uniform in [0, 1): splitmix64 (Steele et al. 2014).
  double next() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
  }

 private:
  std::uint64_t state_;
};

Hit trace(const Scene& scene, const Vec3& origin, const Vec3& direction) {
  Hit hit{nothing_there, {}};
  for (const auto& primitive : scene.primitives) primitive->intersect(origin, direction, hit);
  return hit;
}

/// Direction (z = 1) of the pinhole ray through a point of the picture, in pixels.
Vec3 pixel_direction(const Scene& scene, double x, double y) {
  const double focal = pixel_focal_length(scene.lens, scene.width);
  return {(x - scene.width / 2.0) / focal, (y - scene.height / 2.0) / focal, 1};
}

/// A point of the unit disc, area-preserving (Shirley & Chiu 1997 in polar form).
std::array<double, 2> disc_point(double s, double t) {
  const double r = std::sqrt(s), phi = 2 * std::numbers::pi * t;
  return {r * std::cos(phi), r * std::sin(phi)};
}

/// The mean over a pixel's square and the aperture: the aperture in side x side strata, what is
/// left of the samples and the pixel's square at random.
Vec3 lens_pixel(const Scene& scene, int x, int y, int samples, std::uint32_t seed) {
  Random random(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), seed);
  const int side = std::max(1, static_cast<int>(std::sqrt(samples)));
  const double z0 = scene.lens.focus_distance_units;
  const double radius = scene.lens.aperture_diameter_mm / 2000 / scene.lens.metres_per_unit;
  Vec3 sum;
  for (int i = 0; i < samples; ++i) {
    const bool has_stratum = i < side * side;
    const double s = has_stratum ? (i % side + random.next()) / side : random.next();
    const double t = has_stratum ? (i / side + random.next()) / side : random.next();
    const auto [u, v] = disc_point(s, t);
    const double px = x + random.next(), py = y + random.next();
    const Vec3 d = pixel_direction(scene, px, py);
    const Vec3 origin{radius * u, radius * v, 0};
    // Every lens ray of a picture point meets at its point on the plane of focus.
    const Vec3 direction{d.x - origin.x / z0, d.y - origin.y / z0, 1};
    const Vec3 c = trace(scene, origin, direction).colour;
    sum = {sum.x + c.x, sum.y + c.y, sum.z + c.z};
  }
  return {sum.x / samples, sum.y / samples, sum.z / samples};
}

void store(ScenePicture& picture, std::size_t at, const Vec3& colour) {
  picture.colour[0][at] = static_cast<float>(colour.x);
  picture.colour[1][at] = static_cast<float>(colour.y);
  picture.colour[2][at] = static_cast<float>(colour.z);
}

/// Calls row(y) for every row, on every core.
template <typename Row>
void parallel_rows(int height, const std::function<void(double)>& progress, const Row& row) {
  std::atomic<int> next = 0;
  const auto work = [&](bool reports) {
    for (int y = next++; y < height; y = next++) {
      row(y);
      if (reports && progress) progress(static_cast<double>(y + 1) / height);
    }
  };
  std::vector<std::jthread> helpers;
  for (unsigned i = 1; i < std::thread::hardware_concurrency(); ++i) {
    helpers.emplace_back(work, false);
  }
  work(true);
}

ScenePicture empty_picture(const Scene& scene) {
  const auto pixels =
      static_cast<std::size_t>(scene.width) * static_cast<std::size_t>(scene.height);
  return {std::vector<Plane>(3, Plane(pixels)), {}};
}

std::size_t index_of(const Scene& scene, int x, int y) {
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(scene.width) +
         static_cast<std::size_t>(x);
}

}  // namespace

std::vector<std::string> scene_names() { return {"plate1"}; }

Scene make_scene(const std::string& name, int width, int height) {
  if (width < 1 || height < 1 || width > 16384 || height > 16384) {
    fail(ExitCode::usage, "scene size {}x{}: allowed are 1 to 16384 a side", width, height);
  }
  if (name == "plate1") return make_plate1(width, height);
  fail(ExitCode::usage, "unknown scene '{}'.{} There is: {}", name,
       did_you_mean(name, scene_names()), join(scene_names(), " "));
}

ScenePicture render_pinhole(const Scene& scene) {
  ScenePicture picture = empty_picture(scene);
  picture.depth.resize(picture.colour[0].size());
  parallel_rows(scene.height, {}, [&](int y) {
    for (int x = 0; x < scene.width; ++x) {
      const Hit hit = trace(scene, {}, pixel_direction(scene, x + 0.5, y + 0.5));
      store(picture, index_of(scene, x, y), hit.colour);
      picture.depth[index_of(scene, x, y)] = static_cast<float>(hit.depth);
    }
  });
  return picture;
}

ScenePicture render_truth(const Scene& scene, int samples, std::uint32_t seed,
                          const std::function<void(double)>& progress) {
  if (samples < 1 || samples > 65536) {
    fail(ExitCode::usage, "--truth-samples is {}: allowed are 1 to 65536", samples);
  }
  ScenePicture picture = empty_picture(scene);
  parallel_rows(scene.height, progress, [&](int y) {
    for (int x = 0; x < scene.width; ++x) {
      store(picture, index_of(scene, x, y), lens_pixel(scene, x, y, samples, seed));
    }
  });
  return picture;
}

std::string camera_json(const Scene& scene) {
  const Lens& lens = scene.lens;
  const nlohmann::ordered_json root = {
      {"scene", scene.name},
      {"width", scene.width},
      {"height", scene.height},
      {"focal_length_mm", lens.focal_length_mm},
      {"sensor_width_mm", lens.sensor_width_mm},
      {"pixel_focal_px", pixel_focal_length(lens, scene.width)},
      {"focus_settings",
       {{"default",
         {{"focus_distance_m", lens.focus_distance_units},
          {"aperture_diameter_m", lens.aperture_diameter_mm / 1000},
          {"f_stop", lens.focal_length_mm / lens.aperture_diameter_mm}}}}}};
  return root.dump(2) + "\n";
}

}  // namespace defray
