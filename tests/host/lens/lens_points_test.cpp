// Samples of an aperture: how many, where, how even; that they move nothing.
#include "lens/lens_points.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lens/aperture_mask.h"
#include "lens/lens_grid.h"
#include "support.h"

namespace defray::test::lens_points_test {
namespace {

constexpr int side = ApertureMask::side;
constexpr double radius = 1 << 16;

struct Moments {
  double u = 0, v = 0, uu = 0, vv = 0, uv = 0;
};

void add(Moments& m, double u, double v, double weight) {
  m.u += weight * u, m.v += weight * v;
  m.uu += weight * u * u, m.vv += weight * v * v, m.uv += weight * u * v;
}

Moments moments_of(const LensPoints& lens) {
  Moments m;
  for (const auto& [u, v] : lens.points) {
    add(m, u / radius, v / radius, 1.0 / static_cast<double>(lens.points.size()));
  }
  return m;
}

double centre_of_texel(int i) { return (2 * i + 1 - side) / static_cast<double>(side); }

Moments moments_of(const ApertureMask& mask) {
  double total = 0;
  for (const std::uint8_t value : mask.coverage) total += value;
  Moments m;
  for (int row = 0; row < side; ++row) {
    for (int column = 0; column < side; ++column) {
      add(m, centre_of_texel(column), centre_of_texel(row), mask.at(column, row) / total);
    }
  }
  return m;
}

const std::vector<Aperture>& shapes() {
  static const std::vector<Aperture> all{{},
                                         {0, 0, 0, 2, "", 0},
                                         {6, 0, 0, 1, "", 0},
                                         {4, -1, 10, 1, "", 0},
                                         {8, 0.5, 20, 0.6, "", 0},
                                         {3, 0, 40, 1, "", 0},
                                         {5, 0, 0, 1.5, "", 0},
                                         {7, -0.5, 0, 1, "", 0}};
  return all;
}

TEST(LensSamples, AsManyAsAskedAndWithinTheShape) {
  for (const Aperture& a : shapes()) {
    const ApertureMask mask = rasterise(a);
    for (const int count : {1, 2, 3, 64, 145, 853, 1024, 2100}) {
      const LensPoints lens = make_lens_points(a, count);
      EXPECT_EQ(lens.jitter, 0);
      ASSERT_EQ(lens.points.size(), static_cast<std::size_t>(count));
      for (const auto& [u, v] : lens.points) {
        EXPECT_LE(std::hypot(u, v), radius);
        // A texel that is open in part, at a corner perhaps in less than 1/256: or its neighbour.
        int most = 0;
        for (const int dv : {-128, 0, 128}) {
          for (const int du : {-128, 0, 128}) {
            const int column = std::clamp((u + du + 65536) / 256, 0, side - 1);
            most = std::max<int>(most,
                                 mask.at(column, std::clamp((v + dv + 65536) / 256, 0, side - 1)));
          }
        }
        EXPECT_GT(most, 0) << u << "," << v << " of " << count;
      }
    }
  }
}

TEST(LensSamples, MoveNothingThroughAPointSymmetricShape) {
  for (const Aperture& a : shapes()) {
    if (a.blades % 2 == 1) continue;
    for (const int count : {1, 16, 69, 256, 1025}) {
      const LensPoints lens = make_lens_points(a, count);
      std::int64_t u = 0, v = 0;
      for (const auto& [cu, cv] : lens.points) u += cu, v += cv;
      // Each half of a pair is rounded on its own.
      EXPECT_LE(std::max(std::abs(u), std::abs(v)), count / 2) << a.blades << " " << count;
    }
  }
}

// The promise of the header.
TEST(LensSamples, HaveTheMomentsOfTheShape) {
  for (const Aperture& a : shapes()) {
    const Moments shape = moments_of(rasterise(a));
    for (const int count : {16, 69, 144, 400, 1025}) {
      const Moments m = moments_of(make_lens_points(a, count));
      EXPECT_LE(std::hypot(m.u - shape.u, m.v - shape.v), 0.5 / count) << a.blades << " " << count;
      const double size = shape.uu + shape.vv;
      EXPECT_LE(std::fabs(m.uu - shape.uu), 2 * size / count) << a.blades << " " << count;
      EXPECT_LE(std::fabs(m.vv - shape.vv), 2 * size / count) << a.blades << " " << count;
      EXPECT_LE(std::fabs(m.uv - shape.uv), 2 * size / count) << a.blades << " " << count;
    }
  }
}

/// Largest error, over half-planes in a direction, of the samples' share against the mask's: what a
/// straight edge's blur is off by.
double discrepancy(const LensPoints& lens, const ApertureMask& mask, double angle) {
  constexpr int bins = 4096, reach = 2;
  const auto bin = [&](double u, double v) {
    return static_cast<std::size_t>((u * std::cos(angle) + v * std::sin(angle) + reach) /
                                    (2 * reach) * bins);
  };
  std::vector<double> light(bins), samples(bins);
  double total = 0;
  for (int row = 0; row < side; ++row) {
    for (int column = 0; column < side; ++column) {
      light[bin(centre_of_texel(column), centre_of_texel(row))] += mask.at(column, row);
      total += mask.at(column, row);
    }
  }
  for (const auto& [u, v] : lens.points) {
    samples[bin(u / radius, v / radius)] += 1.0 / static_cast<double>(lens.points.size());
  }
  double error = 0, worst = 0;
  for (std::size_t i = 0; i < bins; ++i) {
    error += light[i] / total;
    worst = std::fmax(worst, std::fabs(error));
    error -= samples[i];
    worst = std::fmax(worst, std::fabs(error));
  }
  return worst;
}

/// The worst of 24 directions with the axes among them.
double discrepancy(const LensPoints& lens, const ApertureMask& mask) {
  double worst = 0;
  for (int direction = 0; direction < 24; ++direction) {
    worst = std::fmax(worst, discrepancy(lens, mask, std::numbers::pi * direction / 24));
  }
  return worst;
}

/// Posts, sills and horizons blur as evenly as so many points can: each column's and each row's
/// share is right to a point and a half, and to what a texel of the mask is wide. (A spiral by
/// itself is off by 3.3 of 137 points.)
TEST(LensSamples, EdgesAlongRowsAndColumnsAreTheMostEven) {
  for (const Aperture& a : shapes()) {
    const ApertureMask mask = rasterise(a);
    for (const int count : {60, 69, 137, 861}) {
      const LensPoints lens = make_lens_points(a, count);
      for (const double angle : {0.0, std::numbers::pi / 2}) {
        EXPECT_LE(discrepancy(lens, mask, angle), 1.5 / count + 0.003)
            << a.blades << " " << count << " " << angle;
      }
    }
  }
}

/// The square grid's cells whose centres are open.
LensPoints grid(const ApertureMask& mask, int cells_per_side) {
  LensPoints open;
  for (const auto& [u, v] : make_lens_grid(cells_per_side, false).points) {
    if (mask.at((u + 65536) / 256, (v + 65536) / 256) >= 128) open.points.push_back({u, v});
  }
  return open;
}

TEST(LensSamples, AreMoreEvenThanAGridOfAsManyCells) {
  SKIP_UNLESS_FULL();
  for (const Aperture& a : shapes()) {
    const ApertureMask mask = rasterise(a);
    for (const int cells_per_side : {9, 16, 33, 64}) {
      const LensPoints lens = grid(mask, cells_per_side);
      const int count = static_cast<int>(lens.points.size());
      const double of_grid = discrepancy(lens, mask);
      const double of_samples = discrepancy(make_lens_points(a, count), mask);
      EXPECT_LT(of_samples, of_grid) << a.blades << " " << count;
    }
  }
}

TEST(LensSamples, RefuseAbsurdCounts) {
  for (const int count : {0, -1, 4097}) {
    expect_error(ErrorKind::usage, {std::to_string(count), "1 to 4096"},
                 [&] { make_lens_points({}, count); });
  }
  expect_error(ErrorKind::usage, {"blades is 2"}, [&] {
    make_lens_points({2, 0, 0, 1, "", 0}, 16);
  });
}

}  // namespace
}  // namespace defray::test::lens_points_test
