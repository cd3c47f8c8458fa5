#pragma once
// What the renderers of the built-in scenes share: rays, hits in their light, loops over pixels.
#include <array>

#include "base/parallel.h"
#include "scenes/geometry/bvh.h"
#include "scenes/tracing/render.h"

namespace defray {

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
  Ray lens_ray(const Lens& lens, double x, double y, const std::array<double, 2>& point) const;

  /// The first hit, in the light it gets; the background, `nothing_there` away, where none is.
  Hit trace(const Ray& ray) const;

 private:
  Vec3 light_at(const Ray& ray, const Hit& hit) const;
  bool is_in_shadow(const Ray& ray, const Hit& hit) const;

  const Scene& scene_;
  Bvh bvh_;
  double focal_px_;
};

/// Radius of the aperture in scene units.
inline double aperture_radius(const Lens& lens) {
  return lens.aperture_diameter_mm / 2000 / lens.metres_per_unit;
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

/// R G B, all 0.
inline std::vector<Plane> empty_planes(const Scene& scene) {
  const auto pixels =
      static_cast<std::size_t>(scene.width) * static_cast<std::size_t>(scene.height);
  return std::vector<Plane>(3, Plane(pixels));
}

inline void store(std::vector<Plane>& planes, std::size_t at, const Vec3& colour) {
  planes[0][at] = static_cast<float>(colour.x);
  planes[1][at] = static_cast<float>(colour.y);
  planes[2][at] = static_cast<float>(colour.z);
}

}  // namespace defray
