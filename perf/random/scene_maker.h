#pragma once
// What random scenes are made with.
#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/random.h"
#include "scenes/geometry/primitives.h"
#include "scenes/scene.h"

namespace defray::perf {

class SceneMaker {
 protected:
  static constexpr double focal_length_mm = 50, sensor_width_mm = 36;

  SceneMaker(const std::string& name, int width, int height, std::uint32_t seed);

  double between(double low, double high) { return low + (high - low) * random_.next(); }
  double log_between(double low, double high) {
    return std::exp(between(std::log(low), std::log(high)));
  }
  bool chance(double share) { return random_.next() < share; }
  int count(int limit) { return static_cast<int>(random_.next() * limit); }
  Vec3 colour() {
    const Vec3 hue{random_.next(), random_.next(), random_.next()};
    return mix({0.5, 0.5, 0.5}, hue, between(0.2, 1)) * log_between(0.1, 1);
  }

  /// Features of so many shares of the picture's width, at this depth.
  double width_at(double depth) const { return depth * sensor_width_mm / focal_length_mm; }

  /// One of five kinds, with features of 1 to 15 % of the picture's width.
  Texture texture(double depth);

  void add(std::unique_ptr<Primitive> primitive) {
    scene_.primitives.push_back(std::move(primitive));
  }

  /// A long rectangle that faces the camera.
  void add_bar(const Vec3& middle, double half_width, double half_length, double angle,
               const Texture& texture);

  /// The scene's one setting: focus on one of the depths; the aperture by the largest CoC, that of
  /// the nearest or farthest.
  void set_focus(const std::string& name);

  Random random_;
  std::uint32_t seed_;
  Scene scene_;
  std::vector<double> depths_;
};

}  // namespace defray::perf
