// Truths of small bright lights against closed forms, and the flat shapes they are made of.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "scenes/geometry/flat_shapes.h"
#include "scenes/tracing/render.h"
#include "support.h"

namespace defray::test::lights_test {
namespace {

constexpr int side = 65;

/// A light in the middle before a dark wall far behind; focused at 2.
Scene light_at(double depth, double radius_px, double radiance) {
  Scene scene;
  scene.width = scene.height = side;
  scene.settings = {{"default", 2, 300}};
  const double radius = radius_px * depth / pixel_focal_length(scene);
  scene.primitives.push_back(
      std::make_unique<Emitter>(Vec3{0, 0, depth}, radius, Vec3{radiance, 0, 0}));
  return scene;
}

Plane truth_of(const Scene& scene, int samples, std::uint32_t seed = 1) {
  return render_truth(scene, lens_of(scene, scene.settings[0]), samples, seed).colour[0];
}

double coc_px(const Scene& scene, double depth) {
  return background_coc_px(lens_of(scene, scene.settings[0]), side) * std::fabs(1 - 2 / depth);
}

TEST(Lights, AreEvenDiscsOfTheRightEnergy) {
  for (const double depth : {1.4, 3.4}) {  // before and behind the plane of focus
    const Scene scene = light_at(depth, 1.5, 5000);
    const double coc = coc_px(scene, depth);
    ASSERT_GT(coc, 2);
    ASSERT_LT(coc, 25);
    const Plane truth = truth_of(scene, 16);  // few samples: they are exact
    const double level = 5000 * 1.5 * 1.5 / (coc * coc);
    for (int y = 0; y < side; ++y) {
      for (int x = 0; x < side; ++x) {
        const double from_middle = std::hypot(x - side / 2, y - side / 2);
        const float value = truth[static_cast<std::size_t>(y * side + x)];
        if (from_middle < coc - 1.5 - 1) {
          EXPECT_NEAR(value / level, 1, 1e-6) << x << " " << y << " at " << depth;
        }
        if (from_middle > coc + 1.5 + 1) {
          EXPECT_EQ(value, 0);
        }
      }
    }
    const double energy = std::accumulate(truth.begin(), truth.end(), 0.0);
    EXPECT_NEAR(energy / (5000 * std::numbers::pi * 1.5 * 1.5), 1, 2e-3);
  }
}

TEST(Lights, AimingAgreesWithWaiting) {
  // A disc of the same size at the same place is found by rays at random alone. A post in focus
  // covers half of the light.
  constexpr double depth = 8, radius_px = 1.5;
  const auto with_post = [&](Scene scene) {
    scene.primitives.push_back(
        std::make_unique<Rectangle>(-9, -9, 0.01, 9, 2, plain({0.5, 0.5, 0.5})));
    return scene;
  };
  Scene discs = light_at(depth, radius_px, 8);
  discs.primitives.clear();
  discs.primitives.push_back(std::make_unique<Disc>(
      Vec3{0, 0, depth}, radius_px * depth / pixel_focal_length(discs), Vec3{8, 0, 0}));
  const Plane aimed = truth_of(with_post(light_at(depth, radius_px, 8)), 256);
  const Plane waited = truth_of(with_post(std::move(discs)), 4096);
  double squares = 0, energy = 0, off_energy = 0;
  for (std::size_t i = 0; i < aimed.size(); ++i) {
    const double off = double{aimed[i]} - waited[i];
    squares += off * off;
    off_energy += off;
    energy += waited[i];
  }
  EXPECT_LT(std::sqrt(squares / (side * side)), 0.003);
  EXPECT_GT(squares, 0);  // they are not the same samples
  EXPECT_NEAR(off_energy / energy, 0, 5e-4);
}

TEST(Lights, ALargeOneIsNotAimedAt) {
  const Scene scene = light_at(2.02, 3, 8);  // CoC far smaller than the light
  const Plane truth = truth_of(scene, 64);
  EXPECT_NEAR(truth[side / 2 * side + side / 2], 8, 1e-6);
  EXPECT_NEAR(std::accumulate(truth.begin(), truth.end(), 0.0) / (8 * std::numbers::pi * 9), 1,
              0.02);
}

TEST(Cutout, AlphaIsNearlyFreeOfNoise) {
  const Scene scene = make_scene("cutout", 80, 60);
  for (const FocusSetting& setting : scene.settings) {
    const Truth truth = render_truth(scene, lens_of(scene, setting), 1024, 1);
    EXPECT_LT(truth.alpha_noise_rms, 1e-3);
    EXPECT_GT(truth.alpha_noise_rms, 0);
    EXPECT_LE(truth.alpha_noise_rms, truth.alpha_noise_worst);
    const auto [least, most] = std::minmax_element(truth.alpha.begin(), truth.alpha.end());
    EXPECT_EQ(*least, 0);
    EXPECT_NEAR(*most, 1, 1e-6);
  }
}

TEST(Cutout, LinesAgreeWithRays) {
  Scene lines = make_scene("cutout", 40, 30), rays = make_scene("cutout", 40, 30);
  rays.background = [](const Vec3&) { return Vec3{}; };  // a background takes rays
  for (const FocusSetting& setting : lines.settings) {
    const Truth a = render_truth(lines, lens_of(lines, setting), 1024, 1);
    const Truth b = render_truth(rays, lens_of(rays, setting), 4096, 1);
    double squares = 0;
    for (std::size_t i = 0; i < a.alpha.size(); ++i) {
      squares +=
          std::pow(a.alpha[i] - b.alpha[i], 2) + std::pow(a.colour[0][i] - b.colour[0][i], 2);
    }
    EXPECT_GT(squares, 0);  // they are not the same samples
    EXPECT_LT(std::sqrt(squares / 1200), 2e-3);
    EXPECT_LT(a.alpha_noise_rms, b.alpha_noise_rms);  // with a quarter of the samples
  }
}

TEST(Shapes, OverlapOfDiscs) {
  EXPECT_EQ(disc_overlap(1.5, 0.5), 0);
  EXPECT_EQ(disc_overlap(0.25, 0.5), 0.25);
  EXPECT_EQ(disc_overlap(0.5, 2), 1);
  for (const double apart : {1e-16, 3e-16, 1e-15, 1e-12}) {
    for (double radius = 0.01; radius < 3; radius *= 1.01) {
      const double most = std::min(1.0, radius * radius);
      EXPECT_NEAR(disc_overlap((1 + radius) * (1 - apart), radius), 0, 1e-6) << radius;
      EXPECT_NEAR(disc_overlap(std::fabs(1 - radius) * (1 + apart), radius), most, 1e-6) << radius;
    }
  }
  EXPECT_NEAR(disc_overlap(1, 1), 2.0 / 3 - std::sqrt(3) / (2 * std::numbers::pi), 1e-12);
  // Against counting.
  for (const double radius : {0.3, 0.9, 1.4}) {
    for (const double distance : {0.6, 1.0, 1.2}) {
      int inside = 0;
      constexpr int n = 400;
      for (int i = 0; i < n * n; ++i) {
        const auto [x, y] = disc_point((i / n + 0.5) / n, (i % n + 0.5) / n);
        inside += std::hypot(x - distance, y) < radius;
      }
      EXPECT_NEAR(disc_overlap(distance, radius), inside / double{n * n}, 1e-3);
    }
  }
}

}  // namespace
}  // namespace defray::test::lights_test
