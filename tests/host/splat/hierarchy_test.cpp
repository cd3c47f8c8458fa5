// The tree of a point cloud, and what a view takes of it.
#include "splat/hierarchy.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include "base/random.h"
#include "base/vec3.h"
#include "splat/cut.h"
#include "splat/splats.h"
#include "splat/view.h"
#include "support.h"

namespace defray::test::hierarchy_test {
namespace {

std::vector<DefraySplatNode> random_points(int count) {
  std::vector<DefraySplatNode> points;
  for (int i = 0; i < count; ++i) {
    Random random(i, 0, 11);
    DefraySplatNode n{};
    n.x = static_cast<float>(random.next());
    n.y = static_cast<float>(2 * random.next());
    n.z = static_cast<float>(0.5 * random.next());
    n.area_z = static_cast<float>(0.1 + random.next());
    n.variance = static_cast<float>(random.next());
    n.cover = static_cast<float>(1 + random.next());
    n.r = static_cast<float>(random.next());
    n.a = 1;
    points.push_back(n);
  }
  return points;
}

Vec3 place(const DefraySplatNode& n) { return {n.x, n.y, n.z}; }

TEST(Hierarchy, NodesStandForAllPointsBelowThem) {
  for (const int count : {1, 2, 4, 5, 6, 9, 100, 1237}) {
    const Hierarchy tree = build_hierarchy(random_points(count));
    ASSERT_EQ(tree.points.size(), size(count));
    for (std::uint32_t i = 0; i < tree.nodes.size(); ++i) {
      const HierarchyNode& node = tree.nodes[i];
      double area = 0, red = 0, variance = 0, cover = 0, xx = 0, xy = 0, xz = 0, yy = 0, yz = 0,
             zz = 0;
      Vec3 mean{};
      for (std::uint32_t k = node.first_point; k < node.end_point; ++k) {
        const DefraySplatNode& p = tree.points[k];
        area += p.area_z;
        red += double{p.area_z} * p.r;
        variance += double{p.area_z} * p.variance;
        cover += double{p.area_z} * p.cover;
        mean = mean + place(p) * p.area_z;
      }
      mean = mean / area;
      for (std::uint32_t k = node.first_point; k < node.end_point; ++k) {
        const DefraySplatNode& p = tree.points[k];
        const Vec3 d = place(p) - mean;
        xx += p.area_z * d.x * d.x;
        xy += p.area_z * d.x * d.y;
        xz += p.area_z * d.x * d.z;
        yy += p.area_z * d.y * d.y;
        yz += p.area_z * d.y * d.z;
        zz += p.area_z * d.z * d.z;
        EXPECT_LE(length(place(p) - place(node.splat)), node.radius * 1.00001 + 1e-6);
      }
      EXPECT_NEAR(node.splat.area_z, area, 1e-4 * area);
      EXPECT_NEAR(node.whole_area, area, 1e-4 * area);
      EXPECT_NEAR(node.splat.r, red / area, 1e-5);
      EXPECT_NEAR(node.splat.variance, variance / area, 1e-5);
      EXPECT_NEAR(node.splat.cover, cover / area, 1e-5);
      EXPECT_LT(length(place(node.splat) - mean), 1e-5);
      EXPECT_NEAR(node.splat.low_xx, xx / area, 1e-5);
      EXPECT_NEAR(node.splat.low_xy, xy / area, 1e-5);
      EXPECT_NEAR(node.splat.low_xz, xz / area, 1e-5);
      EXPECT_NEAR(node.splat.low_yy, yy / area, 1e-5);
      EXPECT_NEAR(node.splat.low_yz, yz / area, 1e-5);
      EXPECT_NEAR(node.splat.low_zz, zz / area, 1e-5);
      EXPECT_LE(node.next, tree.nodes.size());
      EXPECT_GT(node.next, i);
      if (tree.is_leaf(i)) {
        EXPECT_LE(node.end_point - node.first_point, 4u);
      }
    }
    EXPECT_EQ(tree.nodes[0].next, tree.nodes.size());
  }
}

TEST(Hierarchy, DoesNotDependOnTheOrderOfItsPoints) {
  const auto points = random_points(500);
  const Hierarchy a = build_hierarchy(points);
  const Hierarchy b = build_hierarchy({points.rbegin(), points.rend()});
  ASSERT_EQ(a.nodes.size(), b.nodes.size());
  for (std::size_t i = 0; i < a.nodes.size(); ++i) {
    EXPECT_EQ(a.nodes[i].splat.x, b.nodes[i].splat.x);
    EXPECT_EQ(a.nodes[i].splat.low_yy, b.nodes[i].splat.low_yy);
  }
}

TEST(Hierarchy, SidesCancelOnlyWhereTheyAreSeen) {
  auto points = random_points(2);
  points[1].area_z = -points[1].area_z;
  const float both = points[0].area_z - points[1].area_z;
  EXPECT_FLOAT_EQ(build_hierarchy(points).nodes[0].splat.area_z,
                  points[0].area_z + points[1].area_z);
  for (DefraySplatNode& n : points) n.both_sides = 1;
  EXPECT_FLOAT_EQ(std::abs(build_hierarchy(points).nodes[0].splat.area_z), both);
  EXPECT_EQ(build_hierarchy(points).nodes[0].splat.both_sides, 1);
}

/// A grid of points that face the camera, 100 x 100 on 2 x 2 units.
Hierarchy grid() {
  std::vector<DefraySplatNode> points;
  for (int i = 0; i < 10000; ++i) {
    DefraySplatNode n{};
    n.x = static_cast<float>((i % 100 + 0.5) / 50 - 1);
    n.y = static_cast<float>((i / 100 + 0.5) / 50 - 1);
    n.area_z = 0.0004f;
    n.variance = 0.0002f;
    n.cover = 1;
    n.a = 1;
    points.push_back(n);
  }
  return build_hierarchy(points);
}

DefraySplatParams view(int side, double distance, double focus, double aperture_mm) {
  CameraPose pose;
  pose.from = {0, 0, distance};
  Lens lens;
  lens.aperture_diameter_mm = aperture_mm;
  lens.focus_distance_units = focus;
  SplatSettings settings;
  settings.width = settings.height = side;
  return splat_params(pose, {}, lens, settings);
}

double area_of(const Values<DefraySplatNode>& cut) {
  double area = 0;
  for (const DefraySplatNode& n : cut) area += n.area_z;
  return area;
}

TEST(Cut, IsAsFineAsPixelsOrBlurAskFor) {
  const Hierarchy tree = grid();
  // 200 pixels a unit, 4 a point: every point. 20 pixels a unit, 0.4 a point: fewer.
  const auto near = cut_hierarchy(tree, view(800, 4, 4, 0), true);
  EXPECT_EQ(near.size(), 10000u);
  const auto far = cut_hierarchy(tree, view(58, 4, 4, 0), true);
  EXPECT_LT(far.size(), 9000u);
  EXPECT_NEAR(area_of(far), 4, 1e-3);
  EXPECT_EQ(cut_hierarchy(tree, view(58, 4, 4, 0), false).size(), 10000u);
  // Blur of 30 px.
  const DefraySplatParams blurred = view(800, 4, 8, 400);
  EXPECT_GT(std::abs(splat_coc_px(blurred, 4)), 20);
  const auto coarse = cut_hierarchy(tree, blurred, true);
  EXPECT_LT(coarse.size(), 2500u);
  EXPECT_NEAR(area_of(coarse), 4, 1e-3);
  DefraySplatParams wide = blurred;  // as much blur, seen from farther to the sides
  wide.lens_units = 3;
  EXPECT_GT(cut_hierarchy(tree, wide, true).size(), coarse.size());
}

TEST(Cut, KeepsTheHierarchysOrder) {
  const Hierarchy tree = grid();
  const auto all = cut_hierarchy(tree, view(58, 4, 4, 0), false);
  ASSERT_EQ(all.size(), tree.points.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    ASSERT_TRUE(all[i].x == tree.points[i].x && all[i].y == tree.points[i].y) << i;
  }
}

TEST(Splats, AreInOrderOfDepthEqualOnesAsTheyWere) {
  for (const int octaves : {0, 1, 8, 60}) {  // none, two and three digits
    std::vector<DefraySplat> splats(20000);
    std::mt19937 random(5);
    for (std::size_t i = 0; i < splats.size(); ++i) {
      splats[i].z = octaves == 0
                        ? 3
                        : std::ldexp(1.0f + static_cast<float>(random() % 3000) / 3000,
                                     static_cast<int>(random() % size(octaves)) - octaves / 2);
      splats[i].x = static_cast<float>(i);
      splats[i].end_x = splats[i].end_y = i % 5 == 0 ? 0 : 1;  // a fifth has no pixels
    }
    const Values<DefraySplat> sorted = in_order({splats, {}}).all;
    std::erase_if(splats, [](const DefraySplat& s) { return s.end_x == 0; });
    std::stable_sort(splats.begin(), splats.end(),
                     [](const auto& a, const auto& b) { return a.z < b.z; });
    ASSERT_EQ(sorted.size(), splats.size());
    for (std::size_t i = 0; i < splats.size(); ++i) ASSERT_EQ(sorted[i].x, splats[i].x) << i;
  }
  EXPECT_TRUE(in_order({}).all.empty());
}

TEST(Cut, LeavesOutWhatCannotBeSeen) {
  const Hierarchy tree = grid();
  DefraySplatParams p = view(100, 4, 4, 0);
  p.focal_px = 1000;  // 20 x 20 of the points and their reach
  const std::size_t inside = cut_hierarchy(tree, p, false).size();
  EXPECT_LT(inside, 1500u);
  EXPECT_GE(inside, 400u);
  // All of them again where the lens throws them into the picture.
  p.coc_scale_px = 2000;
  p.focus_units = 3;
  EXPECT_EQ(cut_hierarchy(tree, p, false).size(), 10000u);
  // An axis that meets the picture elsewhere moves it.
  DefraySplatParams beside = view(100, 4, 4, 0);
  beside.focal_px = 1000;
  beside.centre_x += 5000;
  EXPECT_TRUE(cut_hierarchy(tree, beside, false).empty());
  EXPECT_TRUE(cut_hierarchy(tree, view(100, -4, 4, 0), false).size() > 0) << "from behind";
  CameraPose away;
  away.from = {0, 0, 4};
  away.look_at = {0, 0, 8};
  Lens lens;
  lens.focus_distance_units = 4;
  EXPECT_TRUE(cut_hierarchy(tree, splat_params(away, {}, lens, {}), false).empty());
}

TEST(View, WhatItRefuses) {
  const auto refused = [](const auto& change, const std::string& words) {
    CameraPose pose;
    Lens lens;
    lens.focus_distance_units = 3;
    SplatSettings settings;
    change(pose, lens, settings);
    try {
      validate(settings);
      splat_params(pose, {}, lens, settings);
      ADD_FAILURE() << words;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::usage);
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
  };
  refused([](auto& pose, auto&, auto&) { pose.look_at = pose.from; }, "looks nowhere");
  refused([](auto& pose, auto&, auto&) { pose.up = {0, 0, 3}; }, "up 0,0,3 is 0, or where");
  refused([](auto& pose, auto&, auto&) { pose.from[1] = NAN; }, "must be finite");
  refused([](auto& pose, auto&, auto&) { pose.from[0] = 1e200; },
          "from 1e+200,0,1 is too far away: allowed are 1e+18 units along each axis");
  refused([](auto& pose, auto&, auto&) { pose.look_at[2] = -2e18; }, "look_at 0,0,-2e+18 is too");
  refused(
      [](auto& pose, auto&, auto&) {
        pose.up = {0, 0, 1e200};
      },
      "up 0,0,1e+200 is 0, or where");
  refused([](auto&, auto& lens, auto&) { lens.focus_end_units = 4; }, "one plane of focus");
  refused([](auto&, auto&, auto& s) { s.width = 0; }, "allowed are 1 to 16384");
  refused([](auto&, auto&, auto& s) { s.height = 20000; }, "allowed are 1 to 16384");
  refused([](auto&, auto&, auto& s) { s.cutoff = 0.5; }, "cutoff is 0.5: allowed are 2 to 3");
  refused([](auto&, auto&, auto& s) { s.transparency = 1; }, "transparency is 1");
}

/// Its length says nothing.
TEST(View, AnyUpWillDo) {
  Lens lens;
  lens.focus_distance_units = 3;
  const auto down = [&](double length) {
    CameraPose pose;
    pose.up = {0, length, 0};
    return splat_params(pose, {}, lens, {}).down_y;
  };
  for (const double length : {1e-200, 1e200}) EXPECT_EQ(down(length), down(1)) << length;
}

}  // namespace
}  // namespace defray::test::hierarchy_test
