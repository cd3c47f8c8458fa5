#include "random/random_scene.h"

#include <cmath>
#include <numbers>

#include "random/scene_maker.h"
#include "scenes/geometry/flat_shapes.h"
#include "scenes/geometry/primitives.h"

namespace defray::perf {
namespace {

class Maker : SceneMaker {
 public:
  Maker(int width, int height, std::uint32_t seed) : SceneMaker("random", width, height, seed) {
    scene_.light = {
        normalized({-0.5, -0.8, -0.45}), {0.85, 0.8, 0.7}, {0.22, 0.26, 0.34}, {0.1, 0.09, 0.08}};
  }

  Scene make() {
    far_ = between(4, 15);
    add_surroundings();
    const int groups = 1 + count(3);
    for (int i = 0; i < groups; ++i) add_group(log_between(1, 0.8 * far_));
    if (chance(0.3)) add_lamps();
    set_focus("random");
    return std::move(scene_);
  }

 private:
  /// A wall, and a floor before it in half of the scenes.
  void add_surroundings() {
    const double w = width_at(far_) * 2;
    add(std::make_unique<Rectangle>(-w, -w, w, w, far_, texture(far_)));
    depths_.push_back(far_);
    if (chance(0.5)) {
      const double y = between(0.4, 0.9);
      add(std::make_unique<Quad>(Vec3{-30, y, 0.5}, Vec3{60, 0, 0}, Vec3{0, 0, 60},
                                 texture(far_ / 2)));
    }
  }

  void add_group(double depth) {
    depths_.push_back(depth);
    switch (count(5)) {
      case 0:
        return add_bars(depth);
      case 1:
        return add_shapes(depth);
      case 2:
        return add_balls(depth);
      case 3:
        return add_blades(depth);
      default:
        return add_panel(depth);
    }
  }

  Vec3 place(double depth) {
    const double w = width_at(depth);
    return {w * between(-0.5, 0.5), w * between(-0.32, 0.32), depth};
  }

  void add_bars(double depth) {
    const int bars = 2 + count(12);
    const double w = width_at(depth), spacing = 1.2 * w / bars;
    const double half = spacing * between(0.05, 0.3), angle = between(-0.8, 0.8);
    const Texture paint = texture(depth);
    for (int i = 0; i < bars; ++i) {
      add_bar({(i + 0.5 - bars / 2.0) * spacing, 0, depth}, half, 2 * w, angle, paint);
    }
  }

  /// Discs and stars.
  void add_shapes(double depth) {
    const int shapes = 2 + count(10);
    for (int i = 0; i < shapes; ++i) {
      const Vec3 middle = place(depth * between(0.9, 1.1));
      const double radius = width_at(depth) * log_between(0.01, 0.12);
      if (chance(0.4)) {
        add(std::make_unique<Disc>(middle, radius, colour()));
        continue;
      }
      const int tips = 3 + count(5);
      const double inner = between(0.3, 1), turn = between(0, 6);
      std::vector<std::array<double, 2>> corners;
      for (int k = 0; k < 2 * tips; ++k) {
        const double angle = std::numbers::pi * k / tips + turn,
                     r = k % 2 ? radius * inner : radius;
        corners.push_back({middle.x + r * std::cos(angle), middle.y + r * std::sin(angle)});
      }
      add(std::make_unique<Polygon>(corners, middle.z, colour()));
    }
  }

  void add_balls(double depth) {
    const int balls = 1 + count(5);
    for (int i = 0; i < balls; ++i) {
      const double z = depth * log_between(0.8, 1.6);
      const double radius = width_at(z) * log_between(0.03, 0.2);
      const Texture skin = texture(width_at(1) * 0.7 / 0.36);
      add(std::make_unique<Ball>(place(z + radius), radius, skin));
    }
  }

  /// Grass and twigs, at all depths around.
  void add_blades(double depth) {
    const int blades = 30 + count(150);
    for (int i = 0; i < blades; ++i) {
      const double z = depth * log_between(0.7, 2);
      const Vec3 one = colour();
      add_bar(place(z), width_at(z) * log_between(0.0008, 0.006),
              width_at(z) * log_between(0.03, 0.2), between(-0.6, 0.6), plain(one));
    }
  }

  /// A slanting board.
  void add_panel(double depth) {
    const double w = width_at(depth) * between(0.15, 0.5), slant = between(-1, 1);
    const Vec3 across{w * std::cos(slant), 0, w * std::sin(slant)};
    const Vec3 corner = place(depth) - across * 0.5;
    add(std::make_unique<Quad>(corner, across, Vec3{0, w * between(0.3, 1), 0}, texture(depth),
                               Quad::Kind::unlit));
  }

  void add_lamps() {
    const int lamps = 2 + count(12);
    for (int i = 0; i < lamps; ++i) {
      const double z = log_between(1.5, 0.9 * far_);
      add(std::make_unique<Emitter>(place(z), 0.0035 * z * between(0.5, 1.5),
                                    colour() * log_between(10, 300)));
    }
  }

  double far_ = 0;
};

}  // namespace

Scene random_scene(int width, int height, std::uint32_t seed) {
  return Maker(width, height, seed).make();
}

}  // namespace defray::perf
