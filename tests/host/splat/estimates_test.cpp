// What a cloud does not say of its points: strays among them, and lines.
#include <cmath>

#include "base/plane.h"
#include "base/random.h"
#include "base/vec3.h"
#include "host/splat/splat_clouds.h"
#include "splat/surfels/surfels.h"
#include "support.h"

namespace defray::test::estimates_test {
namespace {

/// What scans have before a surface is as small as the surface's points, not as far as it is away.
TEST(Estimates, StraysAreSmall) {
  PointCloud cloud = slope(21);
  cloud.positions.push_back({1, 1, 4});
  cloud.positions.push_back({0.5f, 1.5f, 6});
  std::size_t strays = 0;
  for (const DefraySplatNode& n : make_surfels(cloud).points) {
    if (n.z < 3) continue;
    ++strays;
    EXPECT_LE(std::sqrt(n.variance), 0.8 * 0.13);  // along edges spacings are 0.13
    EXPECT_LE(area_of(n), M_PI * std::pow(0.13, 2));
  }
  EXPECT_EQ(strays, 2u);
}

/// One of two hundred, so that many of those around them are others; the edges of a coarse box are
/// not taken for some.
TEST(Estimates, ManyStraysAreSmallAndCoarseBodiesWhole) {
  PointCloud cloud;
  const auto add = [&](const Vec3& p) {
    cloud.positions.push_back(
        {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)});
  };
  constexpr int count = 20000;
  for (int i = 0; i < count; ++i) {
    Random random(i, 0, 4);
    const double y = 2 * random.next() - 1, turn = 2 * M_PI * random.next(),
                 r = std::sqrt(1 - y * y);
    add({r * std::cos(turn), y, r * std::sin(turn)});
    if (i % 200 == 0) {
      add({4 * random.next() - 2, 4 * random.next() - 2, 1.2 + 3 * random.next()});
    }
  }
  for (int i = 0; i < 1200; ++i) {  // 0.14 apart, five times as far as on the ball
    const double along = 0.14 * (i % 14) + 0.07, across = 0.14 * (i / 14 % 14) + 0.07;
    const std::array<double, 3> p{along, across, i / 196 % 2 == 0 ? 0.0 : 1.96};
    const int axis = i / 392;
    if (axis < 3) add({p[size(axis)] - 10, p[size((axis + 1) % 3)], p[size((axis + 2) % 3)]});
  }
  double strays = 0, box = 0;
  const Surfels surfels = make_surfels(cloud);
  ASSERT_EQ(surfels.notes.size(), 1u);
  EXPECT_NE(surfels.notes[0].find(" points lie apart from all surfaces: drawn as small as the"),
            std::string::npos);
  for (const DefraySplatNode& n : surfels.points) {
    if (n.x > -5 && n.z > 1.1f) strays += area_of(n);
    if (n.x < -5) box += area_of(n);
  }
  EXPECT_LT(strays, 0.5);  // as wide as they lie apart: 48
  EXPECT_NEAR(box, 6 * 1.96 * 1.96, 0.1 * 6 * 1.96 * 1.96);
}

/// They are coarser than a body, whose edges have its other points on one side.
TEST(Estimates, StraysDoNotMakeABodysEdgesCoarse) {
  PointCloud cloud;
  constexpr int count = 20000;
  for (int i = 0; i < count + 400; ++i) {
    Random random(i, 0, 12);
    const auto next = [&](double half) {
      return static_cast<float>(half * (2 * random.next() - 1));
    };
    const float half = i < count ? 0.7f : 2;
    cloud.positions.push_back({next(half), next(half), next(half)});
    if (i < count) cloud.positions.back()[size(i % 3)] = i % 2 == 0 ? -half : half;
  }
  double strays = 0;
  for (const DefraySplatNode& n : make_surfels(cloud).points) {
    const float far = std::max({std::fabs(n.x), std::fabs(n.y), std::fabs(n.z)});
    const bool is_on_body = std::fabs(far - 0.7f) < 0.002f;
    if (is_on_body) EXPECT_LT(std::sqrt(n.variance), 0.8 * 0.08) << n.x << " " << n.y;
    if (!is_on_body) strays += area_of(n);
  }
  EXPECT_LT(strays, 1.3);  // as wide as they lie apart: 90; the body is 11.8
}

/// A ball of 20 000 points around the origin.
PointCloud fine_ball(double radius) {
  PointCloud cloud;
  for (int i = 0; i < 20000; ++i) {
    Random random(i, 0, 14);
    const double y = 2 * random.next() - 1, turn = 2 * M_PI * random.next(),
                 r = radius * std::sqrt(1 - y * y);
    cloud.positions.push_back({static_cast<float>(r * std::cos(turn)),
                               static_cast<float>(radius * y),
                               static_cast<float>(r * std::sin(turn))});
  }
  return cloud;
}

/// One to three of a floor's spacings above it: closer to it than its points to each other's
/// neighbours, and as coarse.
TEST(Estimates, StraysAboveACoarseFloorAreNotOfIt) {
  PointCloud cloud = fine_ball(0.4);
  constexpr int row = 40;
  for (int i = 0; i < row * row; ++i) {
    cloud.positions.push_back(
        {0.1f * static_cast<float>(i % row - 20), -0.7f, 0.1f * static_cast<float>(i / row - 20)});
  }
  for (int i = 0; i < 60; ++i) {
    Random random(i, 0, 15);
    const double x = 3.6 * random.next() - 1.8, height = 0.12 + 0.17 * random.next();
    cloud.positions.push_back({static_cast<float>(x), static_cast<float>(height - 0.7),
                               static_cast<float>(0.8 + random.next())});
  }
  double strays = 0, floor = 0;
  for (const DefraySplatNode& n : make_surfels(cloud).points) {
    if (n.y < -0.69f && n.y > -0.71f) floor += area_of(n);
    if (n.y > -0.6f && n.z > 0.7f) strays += area_of(n);
  }
  EXPECT_NEAR(floor, 16, 0.8);
  EXPECT_LT(strays, 0.1);  // as wide as the floor's points: 0.6
}

/// A stray that has others behind it does not lie where a body ends and a coarser one begins.
TEST(Estimates, StraysBehindAStrayAreNoCoarserBody) {
  PointCloud cloud = fine_ball(1);
  for (const auto& [x, y] :
       {std::array{1.25f, 0.0f}, {1.65f, 0.0f}, {1.65f, 0.2f}, {1.6f, -0.4f}}) {
    cloud.positions.push_back({x, y, 0});
  }
  const std::vector<std::string> notes = make_surfels(cloud).notes;
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_EQ(notes[0].find("4 points lie apart"), 0u) << notes[0];
}

TEST(Estimates, NotesLinesTooFarApart) {
  const auto notes = [](int apart) {
    PointCloud cloud;
    for (int i = 0; i < 6000; ++i) {
      Random random(i, 0, 8);
      cloud.positions.push_back({static_cast<float>(i % 200 + 0.1 * random.next()),
                                 static_cast<float>(apart * (i / 200) + 0.1 * random.next()), 0});
    }
    return make_surfels(cloud).notes;
  };
  EXPECT_TRUE(notes(6).empty());
  ASSERT_EQ(notes(12).size(), 1u);
  EXPECT_NE(notes(12)[0].find("% of the points lie along lines farther apart than the 20 nearest"),
            std::string::npos);
}

}  // namespace
}  // namespace defray::test::estimates_test
