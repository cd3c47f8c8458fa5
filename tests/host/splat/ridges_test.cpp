// Where faces of a cloud's surface end at others.
#include "splat/surfels/ridges.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "base/vec3.h"
#include "splat/surfels/surfels.h"

namespace defray::test::ridges_test {
namespace {

constexpr int side_points = 12;
constexpr double step = 0.25;

/// A cube's faces of grids that end half a step before its ridges, from -1.5 to 1.5.
PointCloud cube() {
  PointCloud cloud;
  const auto at = [](int i) { return static_cast<float>(step * (i + 0.5) - 1.5); };
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const float side : {-1.0f, 1.0f}) {
      for (int k = 0; k < side_points * side_points; ++k) {
        std::array<float, 3> place{}, normal{};
        place[axis] = 1.5f * side;
        place[(axis + 1) % 3] = at(k % side_points);
        place[(axis + 2) % 3] = at(k / side_points);
        normal[axis] = side;
        cloud.positions.push_back(place);
        cloud.normals.push_back(normal);
      }
    }
  }
  return cloud;
}

PointCloud ball(int points, double noise) {
  PointCloud cloud;
  for (int i = 0; i < points; ++i) {
    const double z = 1 - (2 * i + 1.0) / points, ring = std::sqrt(1 - z * z), turn = 2.399963 * i;
    Random random(i, 0, 1);
    const auto off = [&] { return noise * (2 * random.next() - 1); };
    const Vec3 place{ring * std::cos(turn), ring * std::sin(turn), z};
    const Vec3 normal = normalized(place + Vec3{off(), off(), off()});
    cloud.positions.push_back({float(place.x), float(place.y), float(place.z)});
    cloud.normals.push_back({float(normal.x), float(normal.y), float(normal.z)});
  }
  return cloud;
}

Vec3 ridge(const Surfels& surfels, const DefraySplatNode& n, std::size_t which) {
  const DefraySplatRidge& r = surfels.ridges[n.ridges * DEFRAY_SPLAT_RIDGES + which];
  return {r.x, r.y, r.z};
}

TEST(Ridges, OfACubeArePointsOwnAndAtCornersTwo) {
  const Surfels surfels = make_surfels(cube());
  for (const DefraySplatNode& n : surfels.points) {
    // How far the other two axes' ridges are.
    double far[3] = {1.5 - std::abs(n.x), 1.5 - std::abs(n.y), 1.5 - std::abs(n.z)};
    std::sort(far, far + 3);
    const double reach = 1.8 * step;  // about what basis functions reach
    if (far[1] > reach) {
      EXPECT_EQ(n.ridges, 0u);
      continue;
    }
    ASSERT_NE(n.ridges, 0u) << n.x << " " << n.y << " " << n.z;
    EXPECT_NEAR(length(ridge(surfels, n, 0)), far[1], 1e-5);
    EXPECT_NEAR(length(ridge(surfels, n, 1)), far[2] < reach ? far[2] : 0, 1e-5);
    for (const std::size_t which : {0u, 1u}) {
      const Vec3 to = ridge(surfels, n, which), at = Vec3{n.x, n.y, n.z} + to;
      if (length(to) == 0) continue;
      EXPECT_NEAR(dot(to, {n.area_x, n.area_y, n.area_z}), 0, 1e-6) << "along its face";
      int on_faces = 0;
      for (const double c : {at.x, at.y, at.z}) on_faces += std::abs(std::abs(c) - 1.5) < 1e-5;
      EXPECT_EQ(on_faces, 2) << "of two faces";
    }
  }
}

/// Nothing is missing there that they would have to reach into.
TEST(Ridges, PointsBesideThemAreAsWideAsOthers) {
  const Surfels surfels = make_surfels(cube());
  const auto [least, most] =
      std::minmax_element(surfels.points.begin(), surfels.points.end(),
                          [](const auto& a, const auto& b) { return a.variance < b.variance; });
  EXPECT_LT(most->variance, 1.2f * least->variance);
}

/// Seen from within, a cube is a room.
TEST(Ridges, OfValleysAreWhereTheyAre) {
  PointCloud room = cube();
  for (auto& normal : room.normals) normal = {-normal[0], -normal[1], -normal[2]};
  const Surfels outside = make_surfels(cube()), inside = make_surfels(room);
  for (std::size_t i = 0; i < outside.points.size(); ++i) {
    for (const std::size_t which : {0u, 1u}) {
      const Vec3 a = ridge(outside, outside.points[i], which);
      EXPECT_LT(length(a - ridge(inside, inside.points[i], which)), 1e-5) << i;
    }
  }
}

std::size_t beside_ridges(const Surfels& surfels) {
  return surfels.ridges.size() / DEFRAY_SPLAT_RIDGES - 1;
}

TEST(Ridges, RoundBodiesHaveNoneHoweverCoarseOrNoisy) {
  for (const int points : {200, 1000, 20000}) {
    EXPECT_EQ(beside_ridges(make_surfels(ball(points, 0))), 0u) << points;
  }
  for (const double noise : {0.15, 0.3, 0.6}) {
    EXPECT_LT(beside_ridges(make_surfels(ball(6000, noise))), 120u) << noise;
  }
}

/// Points' places and normals are off: the face goes on as far as any of the others says.
TEST(Ridges, AreDoubtfulWhereFacesAreNoisy) {
  PointCloud rough = cube();
  for (std::size_t i = 0; i < rough.positions.size(); ++i) {
    Random random(static_cast<int>(i), 0, 2);
    const float off = static_cast<float>(0.1 * step * (2 * random.next() - 1));
    for (std::size_t k = 0; k < 3; ++k) rough.positions[i][k] += off * rough.normals[i][k];
  }
  Neighbours around(rough.positions, neighbour_count);
  CloudPoints points{rough.positions, {}, std::move(around)};
  for (const auto& [x, y, z] : rough.normals) {
    points.points.push_back({.normal = {x, y, z}, .spacing = step});
  }
  find_ridges(points);
  double least = 1;
  for (std::size_t i = 0; i < points.points.size(); ++i) {
    const Vec3& to = points.points[i].ridges[0];
    if (length(to) > 0) least = std::min(least, dot(points.place(i) + to, normalized(to)) - 1.5);
  }
  EXPECT_LT(least, 1);
  EXPECT_GT(least, -0.05 * step);
}

/// Where the other's last row lies farther from the ridge than the half of a step it could cover.
TEST(Ridges, FacesReachOverWhereTheOthersPointsAreFew) {
  PointCloud thinned = cube();
  const auto on_top = [](const std::array<float, 3>& normal) { return normal[2] > 0; };
  for (std::size_t i = thinned.positions.size(); i-- > 0;) {
    if (!on_top(thinned.normals[i]) || thinned.positions[i][0] < 1.5f - static_cast<float>(step)) {
      continue;
    }
    thinned.positions.erase(thinned.positions.begin() + static_cast<std::ptrdiff_t>(i));
    thinned.normals.erase(thinned.normals.begin() + static_cast<std::ptrdiff_t>(i));
  }
  const Surfels surfels = make_surfels(thinned);
  int beside = 0;
  for (const DefraySplatNode& n : surfels.points) {
    const bool is_last = n.area_x > 0 && n.x > 1.4f && n.z > 1.5f - 0.6f * static_cast<float>(step);
    if (!is_last || std::abs(n.y) > 1) continue;
    const Vec3 at = Vec3{n.x, n.y, n.z} + ridge(surfels, n, 0);
    EXPECT_GT(at.z, 1.5 + 0.5 * step);
    EXPECT_LT(at.z, 1.5 + 1.0 * step);
    ++beside;
  }
  EXPECT_EQ(beside, 8);
}

/// Estimated ones turn from one face's to the other's over a few points.
TEST(Ridges, PointsWithoutNormalsHaveNone) {
  PointCloud cloud = cube();
  cloud.normals.clear();
  EXPECT_EQ(beside_ridges(make_surfels(cloud)), 0u);
}

}  // namespace
}  // namespace defray::test::ridges_test
