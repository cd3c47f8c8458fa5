#include "scenes/render.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "error.h"
#include "parallel.h"
#include "random.h"
#include "scenes/bvh.h"

namespace defray {
namespace {

/// A scene made ready for rays.
class Tracer {
 public:
  explicit Tracer(const Scene& scene)
      : scene_(scene), bvh_(scene.primitives), focal_px_(pixel_focal_length(scene)) {}

  /// The pinhole ray through a point of the picture, in pixels.
  Ray pinhole_ray(double x, double y) const {
    return {{}, {(x - scene_.width / 2.0) / focal_px_, (y - scene_.height / 2.0) / focal_px_, 1}};
  }

  /// The ray from a point of the lens (unit disc) that meets the pinhole ray on the plane of focus.
  Ray lens_ray(const Lens& lens, double x, double y, const std::array<double, 2>& point) const {
    const double radius = lens.aperture_diameter_mm / 2000 / lens.metres_per_unit;
    const double z0 = lens.focus_distance_units;
    const Vec3 d = pinhole_ray(x, y).direction;
    const Vec3 origin{radius * point[0], radius * point[1], 0};
    return {origin, {d.x - origin.x / z0, d.y - origin.y / z0, 1}};
  }

  /// The first hit, in the light it gets.
  Hit trace(const Ray& ray) const {
    Hit hit{nothing_there, {}, {}};
    if (bvh_.intersect(ray, hit)) {
      hit.colour = hit.colour * light_at(ray, hit);
    } else if (scene_.background) {
      hit.colour = scene_.background(ray.direction);
    }
    return hit;
  }

 private:
  Vec3 light_at(const Ray& ray, const Hit& hit) const {
    const Light& light = scene_.light;
    const Vec3& n = hit.normal;
    if (dot(n, n) == 0 || dot(light.to_sun, light.to_sun) == 0) return {1, 1, 1};
    const Vec3 ambient = light.ground + (light.sky - light.ground) * (0.5 + 0.5 * dot(n, light.up));
    const double lambert = dot(light.to_sun, n);
    if (lambert <= 0 || is_in_shadow(ray, hit)) return ambient;
    return ambient + light.sun * lambert;
  }

  bool is_in_shadow(const Ray& ray, const Hit& hit) const {
    const double off_surface = 1e-5 * hit.t;  // or rounding would put points into their own shadow
    const Vec3 at = ray.origin + ray.direction * hit.t + hit.normal * off_surface;
    Hit blocker{nothing_there, {}, {}};
    return bvh_.intersect({at, scene_.light.to_sun}, blocker);
  }

  const Scene& scene_;
  Bvh bvh_;
  double focal_px_;
};

/// A point of the unit disc, area-preserving (Shirley & Chiu 1997 in polar form).
std::array<double, 2> disc_point(double s, double t) {
  const double r = std::sqrt(s), phi = 2 * std::numbers::pi * t;
  return {r * std::cos(phi), r * std::sin(phi)};
}

double fraction(double value) { return value - std::floor(value); }

/// The mean over a pixel's square and the aperture. The aperture in side x side strata, what is
/// left of the samples at random; the square by the R2 sequence (Roberts 2018), shifted at random.
Vec3 lens_pixel(const Tracer& tracer, const Lens& lens, int x, int y, int samples, Random random) {
  const int side = static_cast<int>(std::sqrt(samples));
  const double shift_x = random.next(), shift_y = random.next();
  Vec3 sum;
  for (int i = 0; i < samples; ++i) {
    const bool has_stratum = i < side * side;
    const double s = has_stratum ? (i % side + random.next()) / side : random.next();
    const double t = has_stratum ? (i / side + random.next()) / side : random.next();
    const double px = x + fraction(shift_x + 0.7548776662466927 * i);
    const double py = y + fraction(shift_y + 0.5698402909980532 * i);
    sum = sum + tracer.trace(tracer.lens_ray(lens, px, py, disc_point(s, t))).colour;
  }
  return sum / samples;
}

/// Calls pixel(x, y, index) for every pixel, on every core.
template <typename Pixel>
void for_each_pixel(const Scene& scene, const Progress& progress, const Pixel& pixel) {
  parallel_for(
      scene.height,
      [&](int y) {
        const std::size_t row = static_cast<std::size_t>(y) * static_cast<std::size_t>(scene.width);
        for (int x = 0; x < scene.width; ++x) pixel(x, y, row + static_cast<std::size_t>(x));
      },
      progress);
}

std::vector<Plane> empty_planes(const Scene& scene) {
  const auto pixels =
      static_cast<std::size_t>(scene.width) * static_cast<std::size_t>(scene.height);
  return std::vector<Plane>(3, Plane(pixels));
}

void store(std::vector<Plane>& planes, std::size_t at, const Vec3& colour) {
  planes[0][at] = static_cast<float>(colour.x);
  planes[1][at] = static_cast<float>(colour.y);
  planes[2][at] = static_cast<float>(colour.z);
}

/// The picture of what `see` finds along each pinhole ray.
template <typename See>
ScenePicture picture_of(const Scene& scene, const Tracer& tracer, const See& see) {
  ScenePicture picture{empty_planes(scene), {}};
  picture.depth.resize(picture.colour[0].size());
  for_each_pixel(scene, {}, [&](int x, int y, std::size_t at) {
    const Hit hit = see(tracer.pinhole_ray(x + 0.5, y + 0.5));
    store(picture.colour, at, hit.colour);
    picture.depth[at] = static_cast<float>(hit.t);
  });
  return picture;
}

}  // namespace

ScenePicture render_pinhole(const Scene& scene) {
  const Tracer tracer(scene);
  return picture_of(scene, tracer, [&](const Ray& ray) { return tracer.trace(ray); });
}

ScenePicture render_hidden(const Scene& scene) {
  const Tracer tracer(scene);
  return picture_of(scene, tracer, [&](Ray ray) {
    constexpr double apart = 1e-5;  // surfaces nearer to each other than this share are one
    ray.from = tracer.trace(ray).t * (1 + apart);
    return tracer.trace(ray);
  });
}

void check_truth_samples(int samples) {
  if (samples < 1 || samples > 65536) {
    fail(ExitCode::usage, "--truth-samples is {}: allowed are 1 to 65536", samples);
  }
}

Truth render_truth(const Scene& scene, const Lens& lens, int samples, std::uint32_t seed,
                   const Progress& progress) {
  check_truth_samples(samples);
  const Tracer tracer(scene);
  const int counts[2] = {samples - samples / 2, samples / 2};
  std::vector<Plane> mean = empty_planes(scene);
  std::vector<Plane> halves[2] = {mean, mean};
  for_each_pixel(scene, progress, [&](int x, int y, std::size_t at) {
    Vec3 sum;
    for (const std::uint64_t h : {0, 1}) {
      if (counts[h] == 0) continue;
      const Random random(x, y, 2 * std::uint64_t{seed} + h);
      const Vec3 half = lens_pixel(tracer, lens, x, y, counts[h], random);
      store(halves[h], at, half);
      sum = sum + half * counts[h];
    }
    store(mean, at, sum / samples);
  });
  if (samples == 1) return {mean, {}};
  return {mean, compare(halves[0], halves[1], scene.width)};
}

std::vector<Plane> render_accumulation(const Scene& scene, const Lens& lens,
                                       const std::vector<std::array<double, 2>>& lens_points,
                                       const Progress& progress) {
  if (lens_points.empty()) fail(ExitCode::usage, "the accumulation buffer needs a lens point");
  const Tracer tracer(scene);
  std::vector<Plane> mean = empty_planes(scene);
  for_each_pixel(scene, progress, [&](int x, int y, std::size_t at) {
    Vec3 sum;
    for (const auto& point : lens_points) {
      sum = sum + tracer.trace(tracer.lens_ray(lens, x + 0.5, y + 0.5, point)).colour;
    }
    store(mean, at, sum / static_cast<double>(lens_points.size()));
  });
  return mean;
}

}  // namespace defray
