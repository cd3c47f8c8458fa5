#include "random/layered_scene.h"

#include "random/scene_maker.h"
#include "scenes/geometry/texture.h"

namespace defray::perf {
namespace {

class LayeredMaker : SceneMaker {
 public:
  LayeredMaker(int width, int height, std::uint32_t seed)
      : SceneMaker("layered", width, height, seed) {}

  Scene make() {
    double depth = between(4, 15);
    const double w = width_at(depth) * 2;
    depths_.push_back(depth);
    add(std::make_unique<Rectangle>(-w, -w, w, w, depth, paint(depth)));
    const int layers = 1 + count(3);
    for (int i = 0; i < layers; ++i) {
      depth *= between(0.35, 0.9);
      depths_.push_back(depth);
      add_layer(depth);
    }
    set_focus("layered");
    return std::move(scene_);
  }

 private:
  Texture paint(double depth) { return chance(0.2) ? noise(depth) : texture(depth); }

  /// Features of 0.3 to 1 % of the picture's width.
  Texture noise(double depth) {
    const Vec3 a = colour(), b = colour();
    const double size = width_at(depth) * log_between(0.003, 0.01);
    const std::int64_t seed = seed_;
    return [=](const Vec3& p) {
      return mix(a, b, value_noise((p.x + 50) / size, (p.y + 50) / size, seed));
    };
  }

  /// Bars side by side, or a few boards as they fall.
  void add_layer(double depth) {
    const double w = width_at(depth);
    const Texture own = paint(depth);
    if (chance(0.5)) {
      const int bars = 1 + count(10);
      const double spacing = 1.2 * w / bars, half = spacing * between(0.08, 0.35);
      const double angle = between(-0.8, 0.8);
      for (int i = 0; i < bars; ++i) {
        add_bar({(i + 0.5 - bars / 2.0) * spacing, 0, depth}, half, 2 * w, angle, own);
      }
      return;
    }
    const int boards = 1 + count(6);
    for (int i = 0; i < boards; ++i) {
      const Vec3 middle{w * between(-0.5, 0.5), w * between(-0.32, 0.32), depth};
      add_bar(middle, w * log_between(0.01, 0.15), w * log_between(0.03, 0.3), between(-1.5, 1.5),
              own);
    }
  }
};

}  // namespace

Scene layered_scene(int width, int height, std::uint32_t seed) {
  return LayeredMaker(width, height, seed).make();
}

}  // namespace defray::perf
