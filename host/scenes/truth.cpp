// What a lens makes of a built-in scene.
#include <cmath>
#include <numbers>

#include "error.h"
#include "random.h"
#include "scenes/tracer.h"

namespace defray {
namespace {

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

}  // namespace

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
