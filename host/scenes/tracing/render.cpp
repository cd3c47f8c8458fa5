// What the pinhole camera sees of a built-in scene.
#include "scenes/tracing/render.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "scenes/tracing/tracer.h"

namespace defray {
namespace {

/// The i-th of n points spread evenly over the unit square (a lattice of the golden ratio, without
/// the favoured diagonals of Hammersley's); of one point, the centre.
std::array<double, 2> square_point(int i, int n) {
  const double turns = 0.5 + i * std::numbers::phi;
  return {(i + 0.5) / n, turns - std::floor(turns)};
}

ScenePicture empty_picture(const Scene& scene) {
  const std::vector<Plane> colour = empty_planes(scene);
  return {colour, colour[0], colour[0]};
}

/// Colour, depth and alpha of a pixel.
struct Seen {
  Vec3 colour;
  double depth = 0, alpha = 0;
};

Seen mean_of(const Hit* begin, const Hit* end) {
  Seen sum;
  for (const Hit* hit = begin; hit != end; ++hit) {
    sum.colour = sum.colour + hit->colour;
    sum.depth += hit->t;
    sum.alpha += hit->t < nothing_there;
  }
  const auto count = static_cast<double>(end - begin);
  return {sum.colour / count, sum.depth / count, sum.alpha / count};
}

void store(ScenePicture& picture, std::size_t at, const Seen& seen) {
  store(picture.colour, at, seen.colour);
  picture.depth[at] = static_cast<float>(seen.depth);
  picture.alpha[at] = static_cast<float>(seen.alpha);
}

/// What the ray enters next, behind what it hits first.
Hit next_hit(const Tracer& tracer, Ray ray) {
  constexpr double apart = 1e-5;  // surfaces nearer to each other than this share are one
  ray.from = tracer.trace(ray).t * (1 + apart);
  return tracer.trace(ray);
}

/// Hits by depth; how many of them lie before the widest gap, all where it is no silhouette.
std::ptrdiff_t sort_and_split(std::vector<Hit>& hits, double step) {
  std::sort(hits.begin(), hits.end(), [](const Hit& a, const Hit& b) { return a.t < b.t; });
  double widest = 1 + step;
  auto split = hits.end();
  for (auto hit = hits.begin() + 1; hit < hits.end(); ++hit) {
    const double gap = hit->t / (hit - 1)->t;
    if (gap > widest) widest = gap, split = hit;
  }
  return split - hits.begin();
}

}  // namespace

void check_samples(const std::string& name, int samples) {
  if (samples < 1 || samples > 65536) {
    fail(ErrorKind::usage, "{} is {}: allowed are 1 to 65536", field(name), samples);
  }
}

ScenePicture render_pinhole(const Scene& scene, const PinholeSampling& sampling) {
  const int n = sampling.samples;
  check_samples("pinhole_samples", n);
  const Tracer tracer(scene);
  ScenePicture picture = empty_picture(scene);
  for_each_pixel(scene, {}, [&](int x, int y, std::size_t at) {
    std::vector<Hit> hits;
    for (int i = 0; i < n; ++i) {
      const auto [dx, dy] = square_point(i, n);
      hits.push_back(tracer.trace(tracer.pinhole_ray(x + dx, y + dy)));
    }
    Seen seen = mean_of(hits.data(), hits.data() + n);
    const bool takes_centre = n > 1 && !sampling.averages_depth;
    if (takes_centre) seen.depth = tracer.trace(tracer.pinhole_ray(x + 0.5, y + 0.5)).t;
    store(picture, at, seen);
  });
  return picture;
}

ScenePicture render_hidden(const Scene& scene) {
  const Tracer tracer(scene);
  ScenePicture picture = empty_picture(scene);
  for_each_pixel(scene, {}, [&](int x, int y, std::size_t at) {
    const Hit hit = next_hit(tracer, tracer.pinhole_ray(x + 0.5, y + 0.5));
    store(picture, at, mean_of(&hit, &hit + 1));
  });
  return picture;
}

Coverage render_coverage(const Scene& scene, int samples, double step) {
  check_samples("samples", samples);
  if (!(step >= 0) || std::isinf(step)) {
    fail(ErrorKind::usage, "the step of a silhouette is {}: it must be finite and at least 0",
         step);
  }
  const Tracer tracer(scene);
  const ScenePicture empty = empty_picture(scene);
  Coverage coverage{empty, render_hidden(scene), empty.alpha};
  for_each_pixel(scene, {}, [&](int x, int y, std::size_t at) {
    std::vector<Hit> hits;
    for (int i = 0; i < samples; ++i) {
      const auto [dx, dy] = square_point(i, samples);
      hits.push_back(tracer.trace(tracer.pinhole_ray(x + dx, y + dy)));
    }
    const auto front = static_cast<std::size_t>(sort_and_split(hits, step));
    const Hit* const first = hits.data();
    store(coverage.front, at, mean_of(first, first + front));
    if (front < hits.size()) store(coverage.behind, at, mean_of(first + front, first + samples));
    coverage.share[at] = static_cast<float>(front) / static_cast<float>(samples);
  });
  return coverage;
}

}  // namespace defray
