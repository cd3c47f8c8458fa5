// What a lens makes of a built-in scene.
#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/random.h"
#include "scenes/tracing/line_sampler.h"
#include "scenes/tracing/target.h"
#include "scenes/tracing/tracer.h"

namespace defray {
namespace {

/// The i-th of `samples` points of the unit square, at random in side x side strata; what does not
/// fill a square of strata, at random.
std::array<double, 2> stratified(int i, int samples, Random& random) {
  const int side = static_cast<int>(std::sqrt(samples));
  if (i >= side * side) return {random.next(), random.next()};
  const double s = (i % side + random.next()) / side;
  return {s, (i / side + random.next()) / side};
}

class LensSampler {
 public:
  LensSampler(const Scene& scene, const Lens& lens) : tracer_(scene), lens_(lens) {
    for (const auto& primitive : scene.primitives) {
      const auto* emitter = dynamic_cast<const Emitter*>(primitive.get());
      if (!emitter) continue;
      const Target target(scene, lens, *emitter);
      if (target.pays()) targets_.push_back(target);
    }
  }

  /// The mean over a pixel's square and the aperture.
  Exposure pixel(int x, int y, int samples, Random random) const {
    const PixelPoints square(x, y, random);
    Exposure sum;
    for (int i = 0; i < samples; ++i) {
      const auto [s, t] = stratified(i, samples, random);
      const auto [px, py] = square.point(i);
      const Hit hit = tracer_.trace(tracer_.lens_ray(lens_, px, py, disc_point(s, t)));
      if (!is_target(hit.emitter)) sum.colour = sum.colour + hit.colour;
      sum.alpha += hit.t < nothing_there;
    }
    const Ray centre = tracer_.pinhole_ray(x + 0.5, y + 0.5);
    for (const Target& target : targets_) {
      if (target.is_near(centre)) {
        sum.colour = sum.colour + aimed(target, square, samples, random);
      }
    }
    return {sum.colour / samples, sum.alpha / samples};
  }

 private:
  bool is_target(const Emitter* emitter) const {
    if (!emitter) return false;
    return std::any_of(targets_.begin(), targets_.end(),
                       [&](const Target& target) { return target.emitter() == emitter; });
  }

  /// The sum of an emitter's light over `samples` points of the pixel: the share of the lens that
  /// it covers, where a ray from there arrives.
  Vec3 aimed(const Target& target, const PixelPoints& square, int samples, Random& random) const {
    double sum = 0;
    for (int i = 0; i < samples; ++i) {
      const auto [s, t] = stratified(i, samples, random);
      const auto [px, py] = square.point(i);
      const auto centre = target.centre(tracer_.pinhole_ray(px, py));
      const double share = disc_overlap(std::hypot(centre[0], centre[1]), target.radius());
      if (share == 0) continue;
      const auto from = shared_point(centre, target.radius(), disc_point(s, t));
      const Hit hit = tracer_.trace(tracer_.lens_ray(lens_, px, py, from));
      if (hit.emitter == target.emitter()) sum += share;
    }
    return target.emitter()->radiance() * sum;
  }

  Tracer tracer_;
  const Lens& lens_;
  std::vector<Target> targets_;
};

void add_alpha_noise(const Plane halves[2], Truth& truth) {
  double sum = 0;
  for (std::size_t i = 0; i < halves[0].size(); ++i) {
    const double off = std::fabs(halves[0][i] - halves[1][i]) / 2.0;
    sum += off * off;
    truth.alpha_noise_worst = std::max(truth.alpha_noise_worst, off);
  }
  truth.alpha_noise_rms = std::sqrt(sum / static_cast<double>(halves[0].size()));
}

}  // namespace

Truth render_truth(const Scene& scene, const Lens& lens, int samples, std::uint32_t seed,
                   const Progress& progress) {
  check_samples("truth_samples", samples);
  const LensSampler sampler(scene, lens);
  const std::optional<LineSampler> lines = LineSampler::of(scene, lens);
  const int counts[2] = {samples - samples / 2, samples / 2};
  std::vector<Plane> planes = empty_planes(scene);
  Truth truth{planes, planes[0], {}};
  std::vector<Plane> halves[2] = {planes, planes};
  Plane alphas[2] = {planes[0], planes[0]};
  for_each_pixel(scene, progress, [&](int x, int y, std::size_t at) {
    Exposure sum;
    for (const std::uint64_t h : {0u, 1u}) {
      if (counts[h] == 0) continue;
      const Random random(x, y, 2 * std::uint64_t{seed} + h);
      const Exposure half =
          lines ? lines->pixel(x, y, counts[h], random) : sampler.pixel(x, y, counts[h], random);
      store(halves[h], at, half.colour);
      alphas[h][at] = static_cast<float>(half.alpha);
      sum.colour = sum.colour + half.colour * counts[h];
      sum.alpha += half.alpha * counts[h];
    }
    store(truth.colour, at, sum.colour / samples);
    truth.alpha[at] = static_cast<float>(sum.alpha / samples);
  });
  if (samples == 1) return truth;
  truth.noise = compare(halves[0], halves[1], scene.width);
  add_alpha_noise(alphas, truth);
  return truth;
}

std::vector<Plane> render_accumulation(const Scene& scene, const Lens& lens,
                                       const std::vector<std::array<double, 2>>& lens_points,
                                       const Progress& progress) {
  if (lens_points.empty()) fail(ErrorKind::usage, "the accumulation buffer needs a lens point");
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
