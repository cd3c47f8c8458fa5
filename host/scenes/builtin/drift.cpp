// A fence drifting before a portrait: in the fence's soft edges the lens sees more of the face, in
// each frame another part of it.
#include <algorithm>
#include <cmath>

#include "scenes/builtin/builtin.h"
#include "scenes/geometry/primitives.h"
#include "scenes/geometry/texture.h"

namespace defray {
namespace {

constexpr double fence_depth = 1, face_depth = 2.85, wall_depth = 7;
/// 3.37 px a frame in a picture 640 wide, in units.
constexpr double step = 3.37 * 36 / 50 / 640 * fence_depth;

/// 0 below `low`, 1 above `high`, smooth between.
double ramp(double low, double high, double v) {
  const double t = std::clamp((v - low) / (high - low), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

/// 1 inside an ellipse, 0 outside, over an edge as wide as `soft` (of its radius).
double oval(double x, double y, double half_width, double half_height, double soft) {
  return 1 - ramp(1 - soft, 1 + soft, std::hypot(x / half_width, y / half_height));
}

/// Around the middle of an eye.
Vec3 eye(double x, double y, const Vec3& skin) {
  const double r = std::hypot(x, y), turn = std::atan2(y, x);
  const Vec3 iris = mix({0.1, 0.22, 0.3}, {0.3, 0.42, 0.4}, value_noise(9 * turn, 30 * r, 5));
  Vec3 colour{0.82, 0.78, 0.76};
  colour = mix(colour, iris, 1 - ramp(0.062, 0.07, r));
  colour = mix(colour, {0.01, 0.01, 0.012}, 1 - ramp(0.026, 0.032, r));
  colour = mix(colour, {1.4, 1.4, 1.3}, oval(x + 0.02, y + 0.025, 0.012, 0.012, 0.3));
  const double lid = oval(x, y, 0.13, 0.068, 0.1), lashes = oval(x, y + 0.01, 0.15, 0.085, 0.12);
  return mix(mix(skin, {0.06, 0.03, 0.02}, lashes), colour, lid);
}

Vec3 mouth(double x, double y, const Vec3& skin) {
  const double bow = 0.025 * std::cos(14 * x) - 0.25 * x * x;
  const Vec3 lips = mix({0.5, 0.16, 0.15}, {0.66, 0.3, 0.27}, value_noise(90 * x, 12 * y, 6));
  const Vec3 colour = mix(skin, lips, oval(x, y - bow * 0.5, 0.2, 0.07, 0.12));
  return mix(colour, {0.1, 0.02, 0.02}, oval(x, y - bow, 0.17, 0.008, 0.6));
}

/// Strands that run down the head.
Vec3 hair(double x, double y) {
  const double strand = value_noise(70 * x + 9 * std::sin(3 * y), 4 * y, 7);
  return mix({0.05, 0.025, 0.015}, {0.3, 0.17, 0.09}, strand * strand);
}

/// The face on a unit ball, seen from its front: x to the right, y down, -z towards the camera.
Vec3 face(const Vec3& n) {
  const double x = n.x, y = n.y, side = std::fabs(x);
  const double light = 0.62 - 0.25 * x - 0.2 * y - 0.25 * n.z;
  const double pores = value_noise(85 * x, 85 * y, 1) - 0.5;
  const double blotches = value_noise(6 * x, 6 * y, 2) - 0.5;
  const double freckle = ramp(0.78, 0.9, value_noise(38 * x, 38 * y, 3)) * (1 - ramp(0, 0.5, y));
  Vec3 skin = Vec3{0.72, 0.47, 0.36} * (1 + 0.16 * pores + 0.12 * blotches);
  skin = mix(skin, {0.72, 0.32, 0.26}, 0.6 * oval(side - 0.42, y - 0.22, 0.24, 0.2, 0.9));
  skin = mix(skin, {0.4, 0.2, 0.12}, 0.6 * freckle);
  skin = skin * (1 - 0.3 * oval(side - 0.07, y - 0.2, 0.05, 0.06, 0.8));  // nostrils
  skin = skin * (1 + 0.2 * oval(x + 0.02, y - 0.04, 0.05, 0.2, 0.8));     // the nose's ridge
  const double brow = oval(side - 0.31, y + 0.3 - 0.3 * (side - 0.31), 0.17, 0.035, 0.4);
  skin = mix(skin, hair(3 * x, y), brow * (0.5 + 0.5 * value_noise(60 * x, 20 * y, 4)));
  skin = mouth(x, y - 0.45, eye(side - 0.31, y + 0.12, skin));
  const double hairline = -0.52 + 0.5 * side * side + 0.05 * value_noise(9 * x, 1, 8);
  return mix(hair(x, y), skin, ramp(hairline, hairline + 0.07, y)) * light;
}

Vec3 jumper(const Vec3& n) {
  const double knit = std::sin(150 * n.x) * std::sin(110 * n.y + 2 * std::cos(150 * n.x));
  const Vec3 wool = mix({0.08, 0.17, 0.2}, {0.16, 0.3, 0.3}, value_noise(5 * n.x, 9 * n.y, 9));
  return wool * ((0.8 + 0.25 * knit) * (0.75 - 0.3 * n.x));
}

/// Weathered boards, lighter in their middle.
Texture board(double x, double half_width, std::int64_t seed) {
  return [=](const Vec3& p) {
    const double across = (p.x - x) / half_width;
    const double grain = value_noise(400 * (p.x - x), 9 * p.y, seed);
    return Vec3{0.5, 0.44, 0.36} * ((0.45 + 0.5 * grain) * (1 - 0.5 * across * across));
  };
}

}  // namespace

Scene make_drift(int width, int height, int frame) {
  Scene scene;
  scene.width = width;
  scene.height = height;
  constexpr double aperture_mm = 50 / 0.95;
  scene.settings = {{"face", face_depth, aperture_mm}, {"fence", fence_depth, aperture_mm}};
  constexpr double reach = 12;
  scene.primitives.push_back(
      std::make_unique<Rectangle>(-reach, -reach, reach, reach, wall_depth, [](const Vec3& p) {
        const double light = 0.7 + 0.06 * p.x - 0.05 * p.y;
        return bricks(p.x, p.y, 0.5, 0.17) * light;
      }));
  constexpr double head = 0.78, behind_focus = 0.7;
  scene.primitives.push_back(
      std::make_unique<Ball>(Vec3{0.1, -0.05, face_depth + behind_focus}, head, face));
  scene.primitives.push_back(std::make_unique<Ball>(Vec3{0.1, 1.75, 4}, 1.15, jumper));
  const double drift = step * (frame - 1);
  for (int i = -14; i <= 12; ++i) {
    const double half_width = 0.0075 + 0.003 * hash01(i, 1);
    const double x = 0.085 * i + 0.02 * hash01(i, 2) + drift;
    scene.primitives.push_back(std::make_unique<Rectangle>(x - half_width, -2, x + half_width, 2,
                                                           fence_depth, board(x, half_width, i)));
  }
  return scene;
}

}  // namespace defray
