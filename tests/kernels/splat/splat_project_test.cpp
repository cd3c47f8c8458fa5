// Kernel splat_project: what its splats must be, from geometry.
#include <cmath>

#include "base/random.h"
#include "splat_support.h"

namespace defray::test::splat_project_test {
namespace {

/// The variance that a Gaussian splat's conic stands for.
std::array<double, 3> variance_of(const DefraySplat& s) {
  constexpr double form = 0.5;
  const double determinant = double{s.conic_xx} * s.conic_yy - double{s.conic_xy} * s.conic_xy;
  return {form * s.conic_yy / determinant, -form * s.conic_xy / determinant,
          form * s.conic_xx / determinant};
}

SplatSettings gaussians() {
  SplatSettings settings;
  settings.psf = SplatPsf::gaussian;
  return settings;
}

TEST(SplatProject, ASharpSplatIsItsSurfelAndAPixel) {
  const DefraySplatParams p = view_of(256, 4, 0);
  // Focal length 50 of 36 mm on 256 px; a piece of 0.1 x 0.1 turned by 60 degrees about y.
  const double focal = 256 * 50.0 / 36, slant = std::cos(M_PI / 3);
  const DefraySplat s =
      project(surfel(0.3, -0.2, 0, {0.01 * std::sin(M_PI / 3), 0, 0.01 * slant}, 0.0036), p);
  EXPECT_NEAR(s.x, 128 + focal * 0.3 / 4, 1e-3);
  EXPECT_NEAR(s.y, 128 + focal * 0.2 / 4, 1e-3);
  EXPECT_NEAR(s.z, 4, 1e-6);
  // The piece in the picture, by its corners: tangents (cos, 0, -sin) and (0, 1, 0).
  const auto place = [&](double a, double b) {
    const double x = 0.3 + a * slant, y = -0.2 + b, z = 4 + a * std::sin(M_PI / 3);
    return std::array<double, 2>{focal * x / z, -focal * y / z};
  };
  constexpr double step = 1e-4;
  const auto a0 = place(-step, 0), a1 = place(step, 0), b0 = place(0, -step), b1 = place(0, step);
  const double j[4] = {(a1[0] - a0[0]) / (2 * step), (b1[0] - b0[0]) / (2 * step),
                       (a1[1] - a0[1]) / (2 * step), (b1[1] - b0[1]) / (2 * step)};
  const auto w = variance_of(s);
  EXPECT_NEAR(w[0], 0.0036 * (j[0] * j[0] + j[1] * j[1]) + 1, 2e-3);
  EXPECT_NEAR(w[1], 0.0036 * (j[0] * j[2] + j[1] * j[3]), 2e-3);
  EXPECT_NEAR(w[2], 0.0036 * (j[2] * j[2] + j[3] * j[3]) + 1, 2e-3);
  // And it holds as much of the picture as the piece covers.
  const double covered = 0.01 * std::abs(j[0] * j[3] - j[1] * j[2]);
  const double root = std::sqrt(w[0] * w[2] - w[1] * w[1]);
  EXPECT_NEAR(s.amplitude * 2 * M_PI * root * (1 - 3.5 * std::exp(-2.5)), covered, 1e-3 * covered);
}

TEST(SplatProject, BlurIsTheGaussianNearestToTheDisc) {
  for (const double z : {2.0, 8.0}) {
    const DefraySplatParams p = view_of(256, 4, 100, gaussians());
    const double coc = splat_coc_px(p, z);
    EXPECT_NEAR(coc, 0.5 * 0.1 * (256 * 50.0 / 36) * (z - 4) / (4 * z), 1e-4);
    const auto w = variance_of(project(surfel(0, 0, 4 - z, {0, 0, 1e-6}, 1e-9), p));
    EXPECT_NEAR(w[0], coc * coc / (2 * std::log(4)) + 1, 1e-3 * w[0]);
    EXPECT_NEAR(w[1], 0, 1e-4);
  }
}

TEST(SplatProject, TheBlurOfFocusAtInfinity) {
  DefraySplatParams p = view_of(256, 4, 100, gaussians());
  p.focus_is_infinite = 1;
  p.infinite_focus_scale = 20;
  EXPECT_DOUBLE_EQ(splat_coc_px(p, 5), -4);
  const auto w = variance_of(project(surfel(0, 0, -1, {0, 0, 1e-6}, 1e-9), p));
  EXPECT_NEAR(w[0], 16 / (2 * std::log(4)) + 1, 1e-3);
}

/// An ellipse x^T V^-1 x = 1 holds another, touching it, or not.
bool holds(const std::array<double, 3>& outer, const std::array<double, 3>& inner) {
  // outer - inner has no eigenvalue below 0.
  const double a = outer[0] - inner[0], b = outer[1] - inner[1], c = outer[2] - inner[2];
  const double least = 0.5 * (a + c) - std::hypot(0.5 * (a - c), b);
  return least >= -1e-4 * (outer[0] + outer[2]);
}

double area_of(const std::array<double, 3>& v) { return std::sqrt(v[0] * v[2] - v[1] * v[1]); }

TEST(SplatProject, CircumellipseIsTheSmallestAroundLowPassAndBlur) {
  // A flat low-pass at the axis: its variance in the picture is scale^2 times its own.
  const DefraySplatParams p = view_of(256, 4, 100, gaussians());
  const double scale = 256 * 50.0 / 36 / 2,
               blur = std::pow(splat_coc_px(p, 2), 2) / (2 * std::log(4));
  for (int i = 0; i < 200; ++i) {
    Random random(i, 0, 7);
    const double longer = 3 * blur * random.next(), shorter = longer * random.next();
    const double turn = M_PI * random.next(), c = std::cos(turn), s = std::sin(turn);
    const std::array<double, 3> low{longer * c * c + shorter * s * s, (longer - shorter) * c * s,
                                    longer * s * s + shorter * c * c};
    DefraySplatNode node = surfel(0, 0, 2, {0, 0, 1e-6}, 1e-12);
    node.low_xx = static_cast<float>(low[0] / scale / scale);
    node.low_xy = static_cast<float>(-low[1] / scale / scale);  // y points up in the scene
    node.low_yy = static_cast<float>(low[2] / scale / scale);
    std::array<double, 3> made = variance_of(project(node, p));
    made[0] -= 1;
    made[2] -= 1;
    EXPECT_TRUE(holds(made, low)) << i;
    EXPECT_TRUE(holds(made, {blur, 0, blur})) << i;
    // Turned and squeezed a little, none that holds both is smaller.
    for (int k = 0; k < 50; ++k) {
      const double a = M_PI * random.next(), ca = std::cos(a), sa = std::sin(a);
      const double p1 = 4 * blur * random.next(), p2 = 4 * blur * random.next();
      const std::array<double, 3> other{p1 * ca * ca + p2 * sa * sa, (p1 - p2) * ca * sa,
                                        p1 * sa * sa + p2 * ca * ca};
      const auto strictly = [&](const std::array<double, 3>& inner) {
        return holds(other, {inner[0] * 1.001, inner[1] * 1.001, inner[2] * 1.001});
      };
      if (strictly(low) && strictly({blur, 0, blur})) {
        EXPECT_GE(area_of(other), area_of(made) * 0.999) << i;
      }
    }
  }
}

/// A scene and a camera that turn together see the same: the ellipse turns with them.
TEST(SplatProject, CircumellipseTurnsWithTheLowPass) {
  const DefraySplatParams p = view_of(256, 4, 100, gaussians());
  const double scale = 256 * 50.0 / 36 / 2, blur = std::pow(splat_coc_px(p, 2), 2);
  const auto made_of = [&](double turn) {
    const double longer = 2 * blur, shorter = 0.1 * blur, c = std::cos(turn), s = std::sin(turn);
    DefraySplatNode node = surfel(0, 0, 2, {0, 0, 1e-6}, 1e-12);
    node.low_xx = static_cast<float>((longer * c * c + shorter * s * s) / scale / scale);
    node.low_xy = static_cast<float>(-(longer - shorter) * c * s / scale / scale);
    node.low_yy = static_cast<float>((longer * s * s + shorter * c * c) / scale / scale);
    return variance_of(project(node, p));
  };
  const std::array<double, 3> level = made_of(0);
  for (int i = 1; i < 24; ++i) {
    const double turn = i * M_PI / 12, c = std::cos(turn), s = std::sin(turn);
    const std::array<double, 3> turned = made_of(turn);
    const double tolerance = 1e-4 * level[0];
    EXPECT_NEAR(turned[0], level[0] * c * c + level[2] * s * s, tolerance) << i;
    EXPECT_NEAR(turned[1], (level[0] - level[2]) * c * s, tolerance) << i;
    EXPECT_NEAR(turned[2], level[0] * s * s + level[2] * c * c, tolerance) << i;
  }
}

TEST(SplatProject, WhatIsCulled) {
  DefraySplatParams p = view_of(64, 4, 100);
  const std::array<double, 3> facing{0, 0, 0.01}, away{0, 0, -0.01};
  EXPECT_FALSE(is_culled(project(surfel(0, 0, 0, facing, 1e-4), p)));
  EXPECT_TRUE(is_culled(project(surfel(0, 0, 0, away, 1e-4), p)));
  EXPECT_TRUE(is_culled(project(surfel(0, 0, 0, {0.01, 0, 0}, 1e-4), p))) << "edge on";
  EXPECT_TRUE(is_culled(project(surfel(0, 0, 0, {0, 0, 0}, 1e-4), p)));
  EXPECT_TRUE(is_culled(project(surfel(0, 0, 4, facing, 1e-4), p))) << "in the camera";
  EXPECT_TRUE(is_culled(project(surfel(0, 0, 5, facing, 1e-4), p))) << "behind it";
  EXPECT_TRUE(is_culled(project(surfel(0, 0, 3.9, facing, 0.01), p))) << "reaches into it";
  EXPECT_TRUE(is_culled(project(surfel(9, 0, 0, facing, 1e-4), p))) << "beside the picture";
  DefraySplatNode has_two = surfel(0, 0, 0, away, 1e-4);
  has_two.both_sides = 0.6f;
  EXPECT_FALSE(is_culled(project(has_two, p)));
  EXPECT_EQ(project(has_two, p).back, -1);
  EXPECT_EQ(project(surfel(0, 0, 0, facing, 1e-4), p).back, 0);
  p.one_sided = 0;
  EXPECT_FALSE(is_culled(project(surfel(0, 0, 0, away, 1e-4), p)));
  EXPECT_EQ(project(surfel(0, 0, 0, away, 1e-4), p).back, -1);
}

/// By a power of two, so that nothing is rounded: places, areas and variances of up to 10^15 units.
TEST(SplatProject, AnyUnitGivesTheSameSplat) {
  const auto at = [](int exponent) {
    const double unit = std::ldexp(1.0, exponent);
    DefraySplatParams p = view_of(64, 4 * unit, 0);
    p.has_headlight = 1;
    const double area = 0.01 * unit * unit;
    return project(surfel(0.3 * unit, -0.2 * unit, 0, {0.3 * area, 0.2 * area, 0.9 * area},
                          1e-3 * unit * unit),
                   p);
  };
  const DefraySplat here = at(0);
  ASSERT_FALSE(is_culled(here));
  for (const int exponent : {10, 30, 48}) {
    const DefraySplat s = at(exponent);
    EXPECT_EQ(s.amplitude, here.amplitude) << exponent;
    EXPECT_EQ(s.conic_xy, here.conic_xy) << exponent;
    EXPECT_EQ(s.r, here.r) << exponent;
    EXPECT_EQ(s.first_x, here.first_x) << exponent;
    EXPECT_EQ(s.end_y, here.end_y) << exponent;
  }
}

/// A surfel of 7 m, 4 m away, seen from its edge, along the diagonal: a line of any length on the
/// screen, a pixel's prefilter wide.
TEST(SplatProject, ASurfelFromItsEdgeIsALineOfAnyLength) {
  for (const double variance : {1e-4, 1e-2, 1.0, 50.0}) {
    for (const double turn : {0.05, 0.3, 0.785398163, 1.1, 2.7}) {
      DefraySplatParams p = view_of(512, 30, 0);
      p.one_sided = 0;
      p.focal_px *= 100;
      constexpr double off_edge = 1e-6;
      const double size = 12.0, n[3] = {std::cos(turn), std::sin(turn), off_edge};
      const DefraySplatNode node =
          surfel(0, 0, 0, {size * n[0], size * n[1], size * n[2]}, variance);
      const DefraySplat s = project(node, p);
      ASSERT_FALSE(is_culled(s)) << variance << " " << turn;
      // All in doubles: the plane's variance in the picture, and a pixel.
      const double scale = static_cast<double>(p.focal_px) / 30;
      const double v = static_cast<double>(node.variance) * scale * scale;
      const double length = v + 1, width = v * off_edge * off_edge + 1;
      const double amplitude =
          12.0 * scale * scale * off_edge /
          (2 * M_PI * std::sqrt(length * width) * static_cast<double>(p.gaussian_share));
      EXPECT_NEAR(s.amplitude / amplitude, 1, 1e-4) << variance << " " << turn;
    }
  }
}

TEST(SplatProject, AHeadlightShadesBySlant) {
  DefraySplatParams p = view_of(64, 4, 0);
  p.has_headlight = 1;
  EXPECT_NEAR(project(surfel(0, 0, 0, {0, 0, 0.01}, 1e-4), p).r, 1, 1e-5);
  const double slanted = 1.0 / 3 + 2.0 / 3 * std::cos(M_PI / 3);
  const DefraySplat s =
      project(surfel(0, 0, 0, {0.01 * std::sin(M_PI / 3), 0, 0.01 * std::cos(M_PI / 3)}, 1e-4), p);
  EXPECT_NEAR(s.g, slanted, 1e-5);
  EXPECT_EQ(s.a, 1);
}

}  // namespace
}  // namespace defray::test::splat_project_test
