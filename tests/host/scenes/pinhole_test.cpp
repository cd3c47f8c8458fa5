// How built-in scenes' pinhole pictures sample a pixel: colour, alpha, depth, and what covers what.
#include <algorithm>
#include <cmath>

#include "scenes/geometry/primitives.h"
#include "scenes/tracing/render.h"
#include "support.h"

namespace defray::test::pinhole_test {
namespace {

/// A white half-plane at depth 2, its edge through the middle pixel's square at this share of the
/// pixel's width and slanting by `slope` pixels a pixel; a grey wall at depth 8, if wanted.
Scene half_plane(double share, double slope, bool has_wall = true) {
  Scene scene;
  scene.width = scene.height = 9;
  const double pixel = 2 / pixel_focal_length(scene), x = (share - 0.5) * pixel;
  const double turn = std::atan(slope);
  const Vec3 along{std::sin(turn), std::cos(turn), 0}, left{-std::cos(turn), std::sin(turn), 0};
  scene.primitives.push_back(std::make_unique<Quad>(
      Vec3{x, 0, 2} - along * 50, along * 100, left * 50, plain({1, 1, 1}), Quad::Kind::unlit));
  if (has_wall) {
    scene.primitives.push_back(
        std::make_unique<Rectangle>(-90, -90, 90, 90, 8, plain({0.25, 0.25, 0.25})));
  }
  return scene;
}

constexpr std::size_t middle = 4 * 9 + 4;

TEST(Pinhole, ColourIsTheAreaShareAndDepthTheCentres) {
  for (const double slope : {0.0, 0.37, -1.0}) {
    for (const double share : {0.1, 0.3, 0.5001, 0.85}) {
      const Scene scene = half_plane(share, slope);
      // Share of the middle square left of the edge x = share + slope y, y from -1/2 to 1/2.
      double area = 0;
      for (int i = 0; i < 1000; ++i) {
        area += std::clamp(share + slope * ((i + 0.5) / 1000 - 0.5), 0.0, 1.0) / 1000;
      }
      for (const int samples : {16, 100, 256}) {
        const ScenePicture picture = render_pinhole(scene, {samples, false});
        const double off = slope == 0 ? 1.5 / samples : std::pow(samples, -0.75);
        EXPECT_NEAR(picture.colour[1][middle], 0.25 + 0.75 * area, 0.75 * off)
            << share << " slope " << slope << " samples " << samples;
        EXPECT_EQ(picture.depth, render_pinhole(scene).depth);
      }
    }
  }
}

TEST(Pinhole, OneSampleIsTheCentre) {
  const Scene scene = half_plane(0.3, 0);
  const ScenePicture picture = render_pinhole(scene);
  EXPECT_EQ(picture.colour[0][middle], 0.25f);
  EXPECT_EQ(picture.depth[middle], 8);
  EXPECT_EQ(render_pinhole(half_plane(0.7, 0)).depth[middle], 2);
}

TEST(Pinhole, AntialiasedDepthMixesSurfaces) {
  const ScenePicture picture = render_pinhole(half_plane(0.25, 0), {64, true});
  EXPECT_NEAR(picture.depth[middle], 0.25 * 2 + 0.75 * 8, 0.01);
  EXPECT_EQ(picture.depth[middle - 1], 2);
  EXPECT_EQ(picture.depth[middle + 1], 8);
}

TEST(Pinhole, AlphaIsTheShareThatHits) {
  const ScenePicture picture = render_pinhole(half_plane(0.25, 0, false), {64, false});
  EXPECT_NEAR(picture.alpha[middle], 0.25, 1e-6);
  EXPECT_NEAR(picture.colour[2][middle], 0.25, 1e-6);  // premultiplied
  EXPECT_EQ(picture.alpha[middle - 1], 1);
  EXPECT_EQ(picture.alpha[middle + 1], 0);
  EXPECT_EQ(picture.colour[2][middle + 1], 0);
  EXPECT_EQ(render_hidden(half_plane(0.25, 0, false)).alpha[middle - 1], 0);
  EXPECT_EQ(render_hidden(half_plane(0.25, 0)).alpha[middle - 1], 1);
}

TEST(Pinhole, SamplesHaveBounds) {
  const Scene scene = half_plane(0.5, 0);
  expect_error(ErrorKind::usage, {"pinhole_samples is 0", "1 to 65536"},
               [&] { render_pinhole(scene, {0}); });
  expect_error(ErrorKind::usage, {"pinhole_samples is 65537"},
               [&] { render_pinhole(scene, {65537}); });
}

TEST(CoverageTest, PartsAPixelIntoItsSurfaces) {
  const Coverage c = render_coverage(half_plane(0.25, 0), 64);
  EXPECT_NEAR(c.share[middle], 0.25, 1e-6);
  EXPECT_EQ(c.front.colour[0][middle], 1);
  EXPECT_EQ(c.front.depth[middle], 2);
  EXPECT_EQ(c.behind.colour[0][middle], 0.25f);
  EXPECT_EQ(c.behind.depth[middle], 8);
  // Away from the silhouette: whole pixels, and what is hidden behind them.
  EXPECT_EQ(c.share[middle - 1], 1);
  EXPECT_EQ(c.behind.depth[middle - 1], 8);
  EXPECT_EQ(c.share[middle + 1], 1);
  EXPECT_EQ(c.front.depth[middle + 1], 8);
  EXPECT_EQ(c.behind.alpha[middle + 1], 0);
}

TEST(CoverageTest, NothingIsBehindEverything) {
  const Coverage c = render_coverage(half_plane(0.25, 0, false), 64);
  EXPECT_NEAR(c.share[middle], 0.25, 1e-6);
  EXPECT_EQ(c.front.alpha[middle], 1);
  EXPECT_EQ(c.behind.alpha[middle], 0);
  EXPECT_EQ(c.share[middle + 1], 1);
  EXPECT_EQ(c.front.alpha[middle + 1], 0);
}

TEST(CoverageTest, StepDecidesWhatIsASilhouette) {
  const Scene scene = half_plane(0.25, 0);  // depths 2 and 8
  EXPECT_EQ(render_coverage(scene, 64, 3).share[middle], 1);
  EXPECT_NEAR(render_coverage(scene, 64, 2.9).share[middle], 0.25, 1e-6);
  expect_error(ErrorKind::usage, {"step of a silhouette is -1"},
               [&] { render_coverage(scene, 4, -1); });
  expect_error(ErrorKind::usage, {"step of a silhouette is inf"},
               [&] { render_coverage(scene, 4, HUGE_VAL); });
  expect_error(ErrorKind::usage, {"samples is 0"}, [&] { render_coverage(scene, 0); });
}

}  // namespace
}  // namespace defray::test::pinhole_test
