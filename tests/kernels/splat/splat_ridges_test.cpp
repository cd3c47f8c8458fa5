// Point clouds through the lens: faces that meet in sharp edges end there.
#include <cmath>
#include <numbers>
#include <numeric>

#include "splat_support.h"

namespace defray::test::splat_ridges_test {
namespace {

/// A tilted prism's sides, of grids that end half a distance before its ridges, `rows` a unit.
PointCloud prism(int sides, double rows) {
  PointCloud cloud;
  const double half_width = std::tan(M_PI / sides);
  const int across = static_cast<int>(std::round(2 * half_width * rows));
  const auto tilted = [](double x, double y, double z) {
    return std::array{static_cast<float>(x),
                      static_cast<float>(y * std::cos(0.4) - z * std::sin(0.4)),
                      static_cast<float>(y * std::sin(0.4) + z * std::cos(0.4))};
  };
  for (int side = 0; side < sides; ++side) {
    const double turn = 0.4 + 2 * M_PI * side / sides, c = std::cos(turn), s = std::sin(turn);
    for (int i = 0; i < across; ++i) {
      for (double y = -1.5 + 0.5 / rows; y < 1.5; y += 1 / rows) {
        const double along = ((i + 0.5) * 2 / across - 1) * half_width;
        cloud.positions.push_back(tilted(s + along * c, y, c - along * s));
        cloud.normals.push_back(tilted(s, 0, c));
        cloud.colours.push_back({1, 1, 1});
      }
    }
  }
  return cloud;
}

/// What is seen of the one face flat is seen of the other from its edge.
TEST(SplatRidges, FacesOfFewPointsCoverThemselves) {
  for (const int sides : {3, 4, 6, 8, 12, 16, 24}) {
    for (const double rows : {8.0, 13.0, 25.0}) {
      const Hierarchy tree = tree_of(prism(sides, rows));
      for (const SplatPsf psf : {SplatPsf::disc, SplatPsf::gaussian}) {
        SplatSettings settings;
        settings.psf = psf;
        settings.cutoff = psf == SplatPsf::disc ? 2.5 : 2;
        for (const double aperture : {0.0, 100.0, 400.0, 1500.0}) {
          const auto [least, most] =
              range_inside(draw(tree, view_of(300, 4, aperture, settings)).colour[3], 300, 60);
          EXPECT_GE(least, 0.99f) << sides << " sides, " << rows << ", " << aperture << " mm";
          EXPECT_LE(most, 1.0001f) << sides << " sides, " << rows << ", " << aperture << " mm";
        }
      }
    }
  }
}

/// The middle row of a picture of a prism of four sides, each as wide as high, of few points: where
/// its ridges are, from the left, and which sides they are of.
struct FourSides {
  static constexpr double rows = 8;
  DefraySplatParams p = view_of(300, 5, 0);
  double left = 0, middle = 0, right = 0;  // px

  FourSides() {
    for (int k = 0; k < 4; ++k) {
      const double turn = 0.4 + M_PI_4 * (2 * k + 1), far = std::numbers::sqrt2;
      // On the line of sight through the middle row the prism, tilted by 0.4, is seen at z / cos.
      const double z = far * std::cos(turn) / std::cos(0.4);
      const double seen = static_cast<double>(p.focal_px) * far * std::sin(turn) / (5 - z);
      left = std::min(left, seen);
      right = std::max(right, seen);
      if (z > 1) middle = seen;
    }
  }
};

TEST(SplatRidges, FacesEndWhereTheyMeet) {
  const FourSides view;
  const Plane alpha = draw(tree_of(prism(4, FourSides::rows)), view.p).colour[3];
  const double covered = std::accumulate(&alpha[150 * 300], &alpha[151 * 300], 0.0);
  // To a pixel, of 10 that points lie apart.
  EXPECT_NEAR(covered, view.right - view.left, 1);
  const int beyond = static_cast<int>(150 + view.right) + 4;
  EXPECT_LT(alpha[size(150 * 300 + beyond)], 0.01f);
}

/// Else both faces' colours alternate along the ridge.
TEST(SplatRidges, OneFacesColoursEndAtTheOther) {
  const FourSides view;
  PointCloud cloud = prism(4, FourSides::rows);
  for (std::size_t i = 0; i < cloud.colours.size(); ++i) {
    const float red = cloud.normals[i][0] > 0 ? 1 : 0;
    cloud.colours[i] = {red, 0, 1 - red};
  }
  const SplatPlanes planes = draw(tree_of(cloud), view.p);
  const int ridge = static_cast<int>(std::lround(150 + view.middle));
  for (int y = 149; y < 151; ++y) {
    for (int x = ridge - 40; x < ridge + 40; ++x) {
      if (std::abs(x - ridge) < 5) continue;
      EXPECT_NEAR(planes.colour[0][size(y * 300 + x)], x > ridge ? 1 : 0, 0.01) << x - ridge;
    }
  }
}

/// Two boxes side by side, or one, tilted; `inset`: how far from edges grids begin, in steps.
PointCloud boxes(int count, double inset) {
  constexpr int points = 16;
  constexpr double step = 1.0 / points;
  PointCloud cloud;
  const int last = inset > 0 ? points : points + 1;
  for (int box = 0; box < count; ++box) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (const double side : {-0.5, 0.5}) {
        for (int k = 0; k < last * last; ++k) {
          std::array<double, 3> p{}, n{};
          p[axis] = side;
          p[(axis + 1) % 3] = (k % last + inset) * step - 0.5;
          p[(axis + 2) % 3] = (k / last + inset) * step - 0.5;
          p[0] += box - 0.5 * (count - 1);
          n[axis] = side > 0 ? 1 : -1;
          for (auto* v : {&p, &n}) {  // about x, then y
            const double y = (*v)[1] * 0.8 - (*v)[2] * 0.6, z = (*v)[1] * 0.6 + (*v)[2] * 0.8;
            *v = {(*v)[0] * 0.8 + z * 0.6, y, z * 0.8 - (*v)[0] * 0.6};
          }
          cloud.positions.push_back({float(p[0]), float(p[1]), float(p[2])});
          cloud.normals.push_back({float(n[0]), float(n[1]), float(n[2])});
          cloud.colours.push_back({1, 1, 1});
        }
      }
    }
  }
  return cloud;
}

/// As meshes' points do, each with its own face's normal.
TEST(SplatRidges, PointsMayLieOnEdges) {
  for (const double aperture : {0.0, 200.0}) {
    const DefraySplatParams p = view_of(300, 4, aperture);
    const Plane on = draw(tree_of(boxes(1, 0)), p).colour[3];
    EXPECT_GE(range_inside(on, 300, 40).first, 0.99f) << aperture;
    const Plane within = draw(tree_of(boxes(1, 0.5)), p).colour[3];
    double differing = 0, covered = 0;
    for (std::size_t k = 0; k < on.size(); ++k) {
      differing += static_cast<double>(std::abs(on[k] - within[k]));
      covered += static_cast<double>(within[k]);
    }
    EXPECT_LT(differing, 0.02 * covered) << aperture;
  }
}

/// Faces that are one, with others across between them.
TEST(SplatRidges, BoxesThatTouchLeaveNoSeam) {
  for (const double aperture : {0.0, 200.0}) {
    const Plane alpha = draw(tree_of(boxes(2, 0.5)), view_of(300, 4, aperture)).colour[3];
    EXPECT_GE(range_inside(alpha, 300, 40).first, 0.99f) << aperture;
  }
}

/// A piece that faces the camera on its axis, and so the middle of the picture, 4 units away, with
/// ridges so many px from there.
struct Piece {
  DefraySplatParams p = view_of(101, 4, 0);
  double px = 4 / static_cast<double>(view_of(101, 4, 0).focal_px);  // units
  DefraySplatNode node = surfel(0, 0, 0, {0, 0, 0.04}, 0.0144);
  std::vector<DefraySplatRidge> ridges = std::vector<DefraySplatRidge>(2 * DEFRAY_SPLAT_RIDGES);

  Piece() { node.ridges = 1; }

  void set_ridge(std::size_t which, double right_px, double down_px) {
    ridges[DEFRAY_SPLAT_RIDGES + which] = {static_cast<float>(right_px * px),
                                           static_cast<float>(-down_px * px), 0};
  }
  Plane alpha() const {
    return device().splat_resolve(device().splat_project({node}, ridges, p), p).colour[3];
  }
};

TEST(SplatRidges, ASharpKernelIsTheGaussianUpToTheRidgeBlurredByAPixel) {
  Piece piece;
  const Plane whole = [&] {
    Piece without = piece;
    without.node.ridges = 0;
    return without.alpha();
  }();
  piece.set_ridge(0, 3, -4);
  const Plane cut = piece.alpha();
  const double own = 0.0144 / (piece.px * piece.px);  // px^2; of the whole 1 is the prefilter's
  for (int y = 0; y < 101; ++y) {
    for (int x = 0; x < 101; ++x) {
      const std::size_t k = size(y * 101 + x);
      if (whole[k] < 1e-4f) continue;
      // The Gaussian's part before the ridge, and so much blurred by the prefilter: a normal
      // distribution about own / (own + 1) of the way, here an even one of its variance; and 2 %
      // more.
      const double way = 0.6 * (x - 50) - 0.8 * (y - 50);
      const double mean = way * own / (own + 1), deviation = std::sqrt(own / (own + 1));
      const double part = 0.52 + (5 - mean) / (std::sqrt(12.0) * deviation);
      EXPECT_NEAR(cut[k] / whole[k], std::clamp(part, 0.0, 1.0), 2e-3) << x << " " << y;
    }
  }
}

TEST(SplatRidges, OfTwoTheNearerCounts) {
  Piece both, first, second;
  for (Piece* piece : {&both, &first}) piece->set_ridge(0, 4, 0);
  both.set_ridge(1, 0, 6);
  second.set_ridge(0, 0, 6);
  const Plane a = first.alpha(), b = second.alpha(), together = both.alpha();
  for (std::size_t k = 0; k < a.size(); ++k) EXPECT_FLOAT_EQ(together[k], std::min(a[k], b[k]));
}

/// What is all blur has weights with which faces add up to a whole, and nobody sees where one ends.
TEST(SplatRidges, BlurLeavesThemAsTheyWere) {
  Piece piece;
  piece.p = view_of(101, 4, 8000);
  piece.set_ridge(0, 3, 0);
  piece.node.z = -2;
  const Splats splats = device().splat_project({piece.node}, piece.ridges, piece.p);
  ASSERT_EQ(splats.all[0].lines, 1u);
  const DefraySplatLine& line = splats.lines[DEFRAY_SPLAT_RIDGES];
  EXPECT_GT(line.least, 0.9f);
  piece.p = view_of(101, 4, 0);
  EXPECT_EQ(device().splat_project({piece.node}, piece.ridges, piece.p).lines[2].least, 0);
}

TEST(SplatRidges, WhatHasNoPixelsNamesNone) {
  Piece piece;
  piece.set_ridge(0, 3, 0);
  piece.node.x = 100;
  EXPECT_EQ(device().splat_project({piece.node}, piece.ridges, piece.p).all[0].lines, 0u);
}

}  // namespace
}  // namespace defray::test::splat_ridges_test
