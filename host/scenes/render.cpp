// What the pinhole camera sees of a built-in scene.
#include "scenes/render.h"

#include <cmath>

#include "error.h"
#include "scenes/tracer.h"

namespace defray {
namespace {

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

}  // namespace defray
