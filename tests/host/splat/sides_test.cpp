// Clouds without normals: which side is outside.
#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "splat/seen_sides.h"
#include "splat/surfels/surfels.h"
#include "support.h"

namespace defray::test::sides_test {
namespace {

/// Random points on a unit ball's surface below a height.
PointCloud ball(int points, double below = 1) {
  PointCloud cloud;
  for (int i = 0; static_cast<int>(cloud.positions.size()) < points; ++i) {
    Random random(i, 0, 21);
    const double y = 2 * random.next() - 1, turn = 2 * M_PI * random.next();
    const double ring = std::sqrt(1 - y * y);
    if (y > below) continue;
    cloud.positions.push_back({static_cast<float>(ring * std::cos(turn)), static_cast<float>(y),
                               static_cast<float>(ring * std::sin(turn))});
  }
  return cloud;
}

/// A square of points beside the ball, n a side.
void add_patch(PointCloud& cloud, int n) {
  for (int i = 0; i < n * n; ++i) {
    cloud.positions.push_back(
        {static_cast<float>(2 + 0.05 * (i % n)), static_cast<float>(0.05 * (i / n)), 0});
  }
}

double outwards(const DefraySplatNode& n) {
  return static_cast<double>(n.area_x * n.x + n.area_y * n.y + n.area_z * n.z);
}

bool has_two_sides(const DefraySplatNode& n) { return n.both_sides == 1; }

double share_with_two_sides(const Surfels& surfels) {
  return static_cast<double>(
             std::count_if(surfels.points.begin(), surfels.points.end(), has_two_sides)) /
         static_cast<double>(surfels.points.size());
}

TEST(Sides, ClosedSurfacesAreSeenFromOutside) {
  const Surfels surfels = make_surfels(ball(4000));
  EXPECT_FALSE(surfels.has_normals);
  ASSERT_EQ(surfels.points.size(), 4000u);
  for (const DefraySplatNode& n : surfels.points) {
    EXPECT_GT(outwards(n), 0);
    EXPECT_EQ(n.both_sides, 0);
  }
}

/// Of points that happen to lie close to each other noise says more than the surface.
TEST(Sides, NoisyClosedSurfacesAreSeenFromOutside) {
  PointCloud cloud = ball(30000);
  const double apart = std::sqrt(4 * M_PI / 30000);
  for (std::size_t i = 0; i < cloud.positions.size(); ++i) {
    Random random(static_cast<int>(i), 0, 22);
    const double along = random.next() + random.next() + random.next() + random.next() - 2;
    const auto off = static_cast<float>(1 + 0.17 * apart * along / std::sqrt(1.0 / 3));
    for (float& c : cloud.positions[i]) c *= off;
  }
  const Surfels surfels = make_surfels(cloud);
  EXPECT_LT(share_with_two_sides(surfels), 0.05);
  for (const DefraySplatNode& n : surfels.points) EXPECT_TRUE(has_two_sides(n) || outwards(n) > 0);
}

/// Thin legs and ears among them: nearly all as the model's own normals say, or from both sides.
TEST(Sides, NormalsAreThoseOfTheShape) {
  PointCloud cloud = make_point_cloud("figure", 20000);
  const Surfels given = make_surfels(cloud);
  cloud.normals.clear();
  const Surfels found = make_surfels(cloud);
  EXPECT_EQ(share_with_two_sides(given), 0);
  EXPECT_LT(share_with_two_sides(found), 0.03);
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < found.points.size(); ++i) {
    const DefraySplatNode &n = given.points[i], &f = found.points[i];
    ASSERT_TRUE(f.r == n.r && f.g == n.g && f.b == n.b) << "in the same order";
    wrong +=
        !has_two_sides(f) && f.area_x * n.area_x + f.area_y * n.area_y + f.area_z * n.area_z <= 0;
  }
  EXPECT_LT(wrong, given.points.size() / 1000);
}

TEST(Sides, OpenSurfacesAreSeenFromBoth) {
  PointCloud wall, tube;
  add_patch(wall, 40);
  for (int i = 0; i < 6000; ++i) {
    const double turn = 2 * M_PI * (i % 60) / 60;
    tube.positions.push_back({static_cast<float>(std::cos(turn)),
                              static_cast<float>(0.1 * (i / 60)),
                              static_cast<float>(std::sin(turn))});
  }
  for (const PointCloud& cloud : {wall, tube, ball(4000, 0.85)}) {
    EXPECT_EQ(share_with_two_sides(make_surfels(cloud)), 1);
  }
}

/// However much there is of it: a statue and its floor.
TEST(Sides, WhatIsOpenBesideSomethingClosedIsSeenFromBoth) {
  PointCloud cloud = ball(4000);
  for (const int side : {15, 100}) {
    add_patch(cloud, side);
    for (const DefraySplatNode& n : make_surfels(cloud).points) {
      const bool is_ball = n.x < 1.5f;
      EXPECT_EQ(has_two_sides(n), !is_ball);
      if (is_ball) EXPECT_GT(outwards(n), 0);
    }
  }
}

TEST(Sides, ARoomIsAllAroundWhoIsInIt) {
  const Hierarchy tree = build_hierarchy(make_surfels(ball(4000)).points);
  for (const Vec3& in : {Vec3{0, 0, 0}, Vec3{0.6, 0.3, -0.4}}) EXPECT_TRUE(is_within(tree, in));
  for (const Vec3& out : {Vec3{0, 0, 1.2}, Vec3{-3, 2, 0}, Vec3{0, 1e6, 0}}) {
    EXPECT_FALSE(is_within(tree, out));
  }
}

}  // namespace
}  // namespace defray::test::sides_test
