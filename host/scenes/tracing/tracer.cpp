#include "scenes/tracing/tracer.h"

namespace defray {

Ray Tracer::lens_ray(const Lens& lens, double x, double y,
                     const std::array<double, 2>& point) const {
  const double radius = aperture_radius(lens), z0 = lens.focus_distance_units;
  const Vec3 d = pinhole_ray(x, y).direction;
  const Vec3 origin{radius * point[0], radius * point[1], 0};
  return {origin, {d.x - origin.x / z0, d.y - origin.y / z0, 1}};
}

Hit Tracer::trace(const Ray& ray) const {
  Hit hit{nothing_there, {}, {}};
  if (bvh_.intersect(ray, hit)) {
    hit.colour = hit.colour * light_at(ray, hit);
  } else if (scene_.background) {
    hit.colour = scene_.background(ray.direction);
  }
  return hit;
}

Vec3 Tracer::light_at(const Ray& ray, const Hit& hit) const {
  const Light& light = scene_.light;
  const Vec3& n = hit.normal;
  if (dot(n, n) == 0 || dot(light.to_sun, light.to_sun) == 0) return {1, 1, 1};
  const Vec3 ambient = light.ground + (light.sky - light.ground) * (0.5 + 0.5 * dot(n, light.up));
  const double lambert = dot(light.to_sun, n);
  if (lambert <= 0 || is_in_shadow(ray, hit)) return ambient;
  return ambient + light.sun * lambert;
}

bool Tracer::is_in_shadow(const Ray& ray, const Hit& hit) const {
  const double off_surface = 1e-5 * hit.t;  // or rounding would put points into their own shadow
  const Vec3 at = ray.origin + ray.direction * hit.t + hit.normal * off_surface;
  Hit blocker{nothing_there, {}, {}};
  return bvh_.intersect({at, scene_.light.to_sun}, blocker);
}

}  // namespace defray
