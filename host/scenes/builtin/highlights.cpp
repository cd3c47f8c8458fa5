// Small lights far brighter than white before a dark wall, at every blur, in front of the plane of
// focus and behind it; two posts in focus hide parts of those behind. Lengths in pixels are of a
// picture 640 wide.
#include "scenes/builtin/builtin.h"
#include "scenes/geometry/flat_shapes.h"
#include "scenes/geometry/texture.h"

namespace defray {
namespace {

constexpr double focus = 2, wall = 80;
constexpr double aperture_mm = 600;
constexpr double px_per_unit = 640 * 50.0 / 36;  // at depth 1, the focal length in pixels
constexpr double background_coc_px = aperture_mm / 2000 * px_per_unit / focus;
constexpr int columns = 8, rows = 6;

/// The depth at which the CoC radius is this, in pixels; negative: in front of the plane of focus.
double depth_of(double coc_px) { return focus / (1 - coc_px / background_coc_px); }

Vec3 hue_of(double which) {
  return which < 0.4 ? Vec3{1, 0.8, 0.55} : which < 0.7 ? Vec3{0.6, 0.8, 1} : Vec3{1, 0.4, 0.25};
}

/// Light `i`: CoC radius 0.3 to 128 px and radius 0.3 to 3 px in even ratios, in front and behind
/// by turns, its place hashed about a grid's cell.
std::unique_ptr<Emitter> light(const Scene& scene, int i) {
  constexpr int count = columns * rows;
  const double coc_px = 0.3 * std::pow(128 / 0.3, i / (count - 1.0));
  const double z = depth_of(i % 2 ? coc_px : -coc_px);
  const double radius = 0.3 * std::pow(10, hash01(i, 1)) * z / px_per_unit;
  const double intensity = 50 * std::pow(100, hash01(i, 2));
  const int cell = i * 29 % count;  // so that neighbours differ in blur; 29 and 48 share no factor
  const double x = (cell % columns + 0.2 + 0.6 * hash01(i, 3)) / columns - 0.5;
  const double y = (cell / columns + 0.2 + 0.6 * hash01(i, 4)) / rows - 0.5;
  const double width = z * 640 / px_per_unit;
  const double height = width * scene.height / scene.width;
  return std::make_unique<Emitter>(Vec3{x * width, y * height, z}, radius,
                                   hue_of(hash01(i, 5)) * intensity);
}

}  // namespace

Scene make_highlights(int width, int height) {
  Scene scene;
  scene.width = width;
  scene.height = height;
  scene.settings = {{"default", focus, aperture_mm}};
  constexpr double reach = 10 * wall;
  scene.primitives.push_back(
      std::make_unique<Rectangle>(-reach, -reach, reach, reach, wall, [](const Vec3& p) {
        const double cloud = value_noise(0.1 * p.x, 0.1 * p.y, 1);
        return mix({0.012, 0.014, 0.024}, {0.035, 0.03, 0.03}, cloud);
      }));
  for (const double x : {-0.3, 0.12}) {  // 124 and 44 px wide
    const double right = x < 0 ? x + 0.28 : x + 0.1;
    scene.primitives.push_back(
        std::make_unique<Rectangle>(x, -reach, right, reach, focus, [](const Vec3& p) {
          return Vec3{0.05, 0.045, 0.04} * (0.6 + 0.8 * value_noise(12 * p.x, 40 * p.y, 2));
        }));
  }
  for (int i = 0; i < columns * rows; ++i) scene.primitives.push_back(light(scene, i));
  return scene;
}

}  // namespace defray
