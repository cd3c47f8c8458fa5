// Point clouds through the lens: faces of points that are off, lie closer here, or anywhere.
#include "base/random.h"
#include "splat_support.h"

namespace defray::test::splat_uneven_test {
namespace {

/// A cube's faces of grids, their points 0.05 apart, those of its top `finer` times as near to each
/// other; off by so much of that, and normals by so many radians.
PointCloud cube(int finer, double place_noise, double normal_noise) {
  PointCloud cloud;
  const auto add_face = [&](std::size_t axis, float side, int across) {
    for (int i = 0; i < across * across; ++i) {
      Random random(static_cast<int>(cloud.positions.size()), 0, 5);
      const auto off = [&](double most) {
        return static_cast<float>(most * (2 * random.next() - 1));
      };
      const auto at = [&](int k) {
        return (static_cast<float>(k) + 0.5f) / static_cast<float>(across) - 0.5f;
      };
      std::array<float, 3> place{}, normal{};
      place[axis] = 0.5f * side;
      place[(axis + 1) % 3] = at(i % across);
      place[(axis + 2) % 3] = at(i / across);
      normal[axis] = side;
      for (std::size_t k = 0; k < 3; ++k) {
        place[k] += off(0.05 * place_noise);
        normal[k] += off(normal_noise);
      }
      cloud.positions.push_back(place);
      cloud.normals.push_back(normal);
      cloud.colours.push_back({1, 1, 1});
    }
  };
  for (const std::size_t axis : {0u, 1u, 2u}) {
    add_face(axis, -1, 20);
    add_face(axis, 1, axis == 1 ? 20 * finer : 20);
  }
  return cloud;
}

/// Half of the cube's inside, from a side where all that is seen is aslant.
std::pair<float, double> least_and_holes(const PointCloud& cloud, double aperture) {
  CameraPose pose;
  pose.from = {1.5, 1.1, 2};
  Lens lens;
  lens.aperture_diameter_mm = aperture;
  lens.focus_distance_units = 2.7;
  SplatSettings settings;
  settings.width = settings.height = 300;
  DefraySplatParams p = splat_params(pose, {}, lens, settings);
  p.one_sided = 1;
  const Plane alpha = draw(tree_of(cloud), p).colour[3];
  const float least = range_inside(alpha, 300, 50).first;
  double holes = 0;
  for (int y = 90; y < 210; ++y) {
    for (int x = 90; x < 210; ++x) holes += alpha[size(y * 300 + x)] < 0.99f;
  }
  return {least, holes / (120 * 120)};
}

/// What is off aslant is off by more of what points are apart there.
TEST(SplatUneven, NoiseLeavesNoHoles) {
  for (const double aperture : {0.0, 200.0}) {
    EXPECT_LE(least_and_holes(cube(1, 0, 0.1), aperture).second, 0.001) << aperture;
    EXPECT_LE(least_and_holes(cube(1, 0.1, 0), aperture).second, 0.001) << aperture;
    EXPECT_GE(least_and_holes(cube(1, 0.1, 0.1), aperture).first, 0.95f) << aperture;
  }
}

TEST(SplatUneven, FacesWhosePointsLieFartherApartThanOthersAreWhole) {
  for (const auto& [finer, most] : {std::pair{3, 0.01}, {5, 0.01}, {10, 0.0001}}) {
    for (const double aperture : {0.0, 200.0}) {
      EXPECT_LE(least_and_holes(cube(finer, 0, 0), aperture).second, most)
          << finer << ", " << aperture;
    }
  }
}

TEST(SplatUneven, RandomPointsOfFacesLeaveHardlyAny) {
  PointCloud cloud = cube(1, 0, 0);
  for (std::size_t i = 0; i < cloud.positions.size(); ++i) {
    Random random(static_cast<int>(i), 0, 9);
    for (std::size_t k = 0; k < 3; ++k) {
      if (cloud.normals[i][k] == 0)
        cloud.positions[i][k] = static_cast<float>(random.next()) - 0.5f;
    }
  }
  for (const double aperture : {0.0, 200.0}) {
    EXPECT_LE(least_and_holes(cloud, aperture).second, 0.004) << aperture;
  }
}

}  // namespace
}  // namespace defray::test::splat_uneven_test
