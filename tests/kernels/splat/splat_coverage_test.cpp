// Point clouds through the lens: what is solid is covered.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/random.h"
#include "splat_support.h"

namespace defray::test::splat_coverage_test {
namespace {

/// The built-in figure in white.
PointCloud white_figure() {
  PointCloud cloud = make_point_cloud("figure", 20000);
  for (auto& colour : cloud.colours) colour = {1, 1, 1};
  return cloud;
}

TEST(SplatCoverage, AClosedSurfaceCoversItsInsideAtEveryApertureAndCutOff) {
  const Hierarchy tree = tree_of(white_figure());
  for (const double aperture :
       {0.0, 30.0, 60.0, 100.0, 140.0, 180.0, 220.0, 300.0, 400.0, 800.0, 1200.0, 2000.0}) {
    for (const double cutoff : {2.0, 2.5, 3.0}) {
      for (const SplatPsf psf : {SplatPsf::gaussian, SplatPsf::disc}) {
        SplatSettings settings;
        settings.cutoff = cutoff;
        settings.psf = psf;
        const DefraySplatParams p = view_of(160, 4, aperture, settings);
        const auto [least, most] = range_inside(draw(tree, p).colour[3], 160, 12);
        EXPECT_GE(least, 0.99f) << aperture << " mm, c " << cutoff << ", psf " << int(psf);
        EXPECT_LE(most, 1.01f) << aperture << " mm, c " << cutoff << ", psf " << int(psf);
      }
    }
  }
}

/// A rod with a round end, of so many points, which points at the camera.
PointCloud rod(std::size_t end_points, bool has_normals) {
  constexpr double radius = 0.5, length = 2;
  PointCloud cloud;
  const auto add = [&](double x, double y, double z, double back) {
    cloud.positions.push_back({static_cast<float>(radius * x), static_cast<float>(radius * y),
                               static_cast<float>(radius * z - back)});
    if (has_normals) {
      cloud.normals.push_back(
          {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)});
    }
    cloud.colours.push_back({1, 1, 1});
  };
  const double golden = M_PI * (3 - std::sqrt(5.0)), count = static_cast<double>(end_points);
  const double spacing = radius * std::sqrt(2 * M_PI / count);
  for (std::size_t i = 0; i < end_points; ++i) {
    const double z = 1 - (static_cast<double>(i) + 0.5) / count, ring = std::sqrt(1 - z * z);
    const double turn = golden * static_cast<double>(i);
    add(ring * std::cos(turn), ring * std::sin(turn), z, 0);
  }
  const int around = static_cast<int>(2 * M_PI * radius / spacing);
  for (double back = spacing / 2; back < length; back += spacing) {
    for (int k = 0; k < around; ++k) {
      const double turn = 2 * M_PI * k / around;
      add(std::cos(turn), std::sin(turn), 0, back);
    }
  }
  return cloud;
}

TEST(SplatCoverage, ATipOfFewPointsCoversWhatIsBehind) {
  for (const bool has_normals : {true, false}) {
    for (const std::size_t points : {60, 200}) {
      const Hierarchy tree = tree_of(rod(points, has_normals));
      const DefraySplatParams p = view_of(160, 4, 0);
      const auto [least, most] = range_inside(draw(tree, p).colour[3], 160, 10);
      EXPECT_GE(least, 0.985f) << points << " points, normals " << has_normals;
      EXPECT_LE(most, 1.0001f) << points << " points, normals " << has_normals;
    }
  }
}

TEST(SplatCoverage, IrregularPointsCoverTheirSurface) {
  // A jittered grid: what weighing is for.
  PointCloud cloud = wall(100, 1, 0, {1, 1, 1});
  for (std::size_t i = 0; i < cloud.positions.size(); ++i) {
    Random random(static_cast<int>(i), 0, 3);
    cloud.positions[i][0] += static_cast<float>(0.02 * (random.next() - 0.5));
    cloud.positions[i][1] += static_cast<float>(0.02 * (random.next() - 0.5));
  }
  const DefraySplatParams p = view_of(128, 4, 0);
  const auto [least, most] = range_inside(draw(tree_of(cloud), p).colour[3], 128, 30);
  EXPECT_GE(least, 0.99f);
  EXPECT_LE(most, 1.0001f);
}

/// Scans' points are nearer to each other here than there: gaps of three distances are filled, and
/// blur makes nothing of what fills them.
TEST(SplatCoverage, PointsInRandomPlacesLeaveNoHoles) {
  PointCloud wall, ball;
  for (int i = 0; i < 20000; ++i) {
    Random random(i, 0, 4);
    const double u = 2 * random.next() - 1, v = random.next(), ring = std::sqrt(1 - u * u);
    wall.positions.push_back({static_cast<float>(1.3 * u), static_cast<float>(2.6 * v - 1.3), 0});
    wall.normals.push_back({0, 0, 1});
    ball.normals.push_back({static_cast<float>(ring * std::cos(2 * M_PI * v)),
                            static_cast<float>(ring * std::sin(2 * M_PI * v)),
                            static_cast<float>(u)});
  }
  ball.positions = ball.normals;
  for (const PointCloud& cloud : {wall, ball}) {
    const Hierarchy tree = tree_of(cloud);
    for (const double aperture : {0.0, 100.0, 800.0}) {
      const Plane alpha = draw(tree, view_of(160, 4, aperture)).colour[3];
      std::size_t holes = 0;
      for (int y = 60; y < 100; ++y) {
        for (int x = 60; x < 100; ++x) holes += alpha[size(y * 160 + x)] < 0.98f;
      }
      EXPECT_LE(holes, 1600 / 20) << aperture;
      const auto [least, most] = range_inside(alpha, 160, 20);
      EXPECT_GE(least, 0.75f) << aperture;
      EXPECT_LE(most, 1.0001f) << aperture;
    }
  }
}

/// Sheets are as large as their points say, whether these lie on a grid or anywhere: what reaches
/// over an edge is as much as what the last row leaves open, sharp and blurred.
TEST(SplatCoverage, SurfacesEndWhereTheirPointsDo) {
  for (const double jitter : {0.0, 0.5, 1.0}) {  // in distances; 1: anywhere
    PointCloud sheet;
    for (int i = 0; i < 2500; ++i) {
      Random random(i, 0, 6);
      const auto place = [&](int k) {
        const double moved = k + 0.5 + jitter * (random.next() - 0.5);
        return static_cast<float>((jitter < 1 ? moved : 50 * random.next()) / 25 - 1);
      };
      sheet.positions.push_back({place(i % 50), place(i / 50), -1});
      sheet.normals.push_back({0, 0, 1});
    }
    const Hierarchy tree = tree_of(sheet);
    for (const double aperture : {0.0, 200.0}) {
      const DefraySplatParams p = view_of(160, 4, aperture);
      const Plane alpha = draw(tree, p).colour[3];
      const double side_px = 2 * static_cast<double>(p.focal_px) / 5;
      const double covered = std::accumulate(alpha.begin(), alpha.end(), 0.0);
      EXPECT_NEAR(covered / (side_px * side_px), 1, 0.012) << jitter << ", " << aperture << " mm";
    }
  }
}

/// Nodes that stand for many points lie less evenly than these, and lenses as wide as the ball see
/// them from its sides, too.
TEST(SplatCoverage, EvenBallsAndTheirNodesLeaveNoHoles) {
  for (const int points : {1500, 5000, 20000}) {
    PointCloud ball;
    for (int i = 0; i < points; ++i) {
      const double z = 1 - (2 * i + 1.0) / points, ring = std::sqrt(1 - z * z), turn = 2.399963 * i;
      ball.positions.push_back({static_cast<float>(ring * std::cos(turn)),
                                static_cast<float>(ring * std::sin(turn)), static_cast<float>(z)});
    }
    ball.normals = ball.positions;
    const Hierarchy tree = tree_of(ball);
    for (const SplatPsf psf : {SplatPsf::disc, SplatPsf::gaussian}) {
      for (const double cutoff : {2.0, 2.5}) {
        SplatSettings settings;
        settings.psf = psf;
        settings.cutoff = cutoff;
        for (const double aperture : {0.0, 400.0, 800.0, 1500.0, 4000.0}) {
          const auto [least, most] =
              range_inside(draw(tree, view_of(300, 4, aperture, settings)).colour[3], 300, 45);
          EXPECT_GE(least, 0.99f) << points << " points, " << aperture << " mm, c " << cutoff;
          EXPECT_LE(most, 1.0001f) << points << " points, " << aperture << " mm, c " << cutoff;
        }
      }
    }
  }
}

/// Of points anywhere on a plane, steep or not: up to a third of their distance too near, as the
/// nearest count where they make more than a whole. The nearest one's was up to 2.5 of it.
TEST(SplatCoverage, DepthsAreTheSurfaces) {
  constexpr double side = 4, distance_of_points = side / 200;
  for (const double slant : {0.0, 0.6, 1.1}) {
    PointCloud plane;
    for (int i = 0; i < 40000; ++i) {
      Random random(i, 0, 7);
      const double u = side * (random.next() - 0.5), v = side * (random.next() - 0.5);
      plane.positions.push_back({static_cast<float>(u), static_cast<float>(v * std::cos(slant)),
                                 static_cast<float>(v * std::sin(slant))});
    }
    const DefraySplatParams p = view_of(128, 5, 0);
    const SplatPlanes planes = draw(tree_of(plane), p);
    double sum = 0;
    for (int y = 44; y < 84; ++y) {
      const double up = (63.5 - y) / static_cast<double>(p.focal_px);
      const double depth = 5 / (1 + up * std::tan(slant));
      for (int x = 20; x < 108; ++x) {
        const double off = static_cast<double>(planes.depth[size(y * 128 + x)]) - depth;
        ASSERT_NEAR(off, 0, 2 * distance_of_points) << slant << ", " << x << " " << y;
        sum += off;
      }
    }
    EXPECT_NEAR(sum / (40 * 88), 0, distance_of_points / 3) << slant;
  }
}

/// Where a closed surface ends a scan has a hole: filled, if it is as small. Given normals say
/// nothing of that.
TEST(SplatCoverage, AClosedBodysSmallHolesAreFilled) {
  PointCloud ball;
  for (int i = 0; i < 20000; ++i) {
    const double z = 1 - (i + 0.5) / 10000, ring = std::sqrt(1 - z * z), turn = 2.399963 * i;
    if (ring < 0.09 && z > 0) continue;  // 3.6 distances of points around the middle
    ball.positions.push_back({static_cast<float>(ring * std::cos(turn)),
                              static_cast<float>(ring * std::sin(turn)), static_cast<float>(z)});
  }
  const DefraySplatParams p = view_of(160, 4, 0);
  const auto least = [&] { return range_inside(draw(tree_of(ball), p).colour[3], 160, 8).first; };
  EXPECT_GE(least(), 0.45f);
  ball.normals = ball.positions;
  EXPECT_LE(least(), 0.05f);
}

}  // namespace
}  // namespace defray::test::splat_coverage_test
