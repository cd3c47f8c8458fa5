// The generator of the gather's samples: distances, evenness, order, seeds.
#include "lens/poisson_disk.h"

#include <cmath>
#include <numbers>

#include "support.h"

namespace defray::test::poisson_disk_test {
namespace {

double distance(const std::array<double, 2>& a, const std::array<double, 2>& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1]);
}

TEST(PoissonDisk, EveryBeginningKeepsItsDistance) {
  for (const std::uint32_t seed : {0u, 1u, 77u}) {
    for (const int count : {31, 32, 500}) {
      const PoissonDisk disk = make_poisson_disk(count, seed);
      ASSERT_EQ(disk.points.size(), std::size_t(count));
      double closest = 2;
      for (int n = 1; n <= count; ++n) {
        EXPECT_LE(std::hypot(disk.points[n - 1][0], disk.points[n - 1][1]), 1 + 1e-15);
        for (int i = 0; i + 1 < n; ++i) {
          closest = std::fmin(closest, distance(disk.points[i], disk.points[n - 1]));
        }
        EXPECT_GE(closest, disk.spacing[n - 1]) << "the first " << n << ", seed " << seed;
        const double hexagonal = std::sqrt(2 * std::numbers::pi / (std::numbers::sqrt3 * n));
        // The promise of the header; a single point or pair fits more loosely than any grid.
        EXPECT_GE(disk.spacing[n - 1], (n < 3 ? 0.5 : 0.6) * hexagonal)
            << "the first " << n << " of " << count << ", seed " << seed;
      }
    }
  }
}

TEST(PoissonDisk, MeansAreZeroAndDiscsEvenlyFilled) {
  const PoissonDisk disk = make_poisson_disk(256, 3);
  double x = 0, y = 0, squares = 0;
  for (std::size_t n = 0; n < disk.points.size(); ++n) {
    x += disk.points[n][0], y += disk.points[n][1];
    squares +=
        x * 0 + disk.points[n][0] * disk.points[n][0] + disk.points[n][1] * disk.points[n][1];
    if (n % 2 == 1) {
      EXPECT_EQ(x, 0) << n;
      EXPECT_EQ(y, 0) << n;
    }
    // The mean square radius of a uniform disc is 1/2.
    if (n == 15 || n == 31 || n == 255) {
      EXPECT_NEAR(squares / (n + 1), 0.5, 0.05) << n + 1;
    }
  }
  EXPECT_EQ(make_poisson_disk(7, 3).points[0], (std::array<double, 2>{0, 0}));
}

TEST(PoissonDisk, SeedsDifferAndRepeat) {
  const PoissonDisk a = make_poisson_disk(64, 1), b = make_poisson_disk(64, 2);
  EXPECT_NE(a.points, b.points);
  EXPECT_EQ(a.points, make_poisson_disk(64, 1).points);
  // Progressive: fewer points of the same seed are the beginning of more.
  const PoissonDisk fewer = make_poisson_disk(20, 1);
  EXPECT_TRUE(std::equal(fewer.points.begin(), fewer.points.end(), a.points.begin()));
}

TEST(PoissonDisk, RefusesAbsurdCounts) {
  for (const int count : {0, -3, 1025}) {
    expect_error(ErrorKind::usage, {std::to_string(count), "1 to 1024"},
                 [&] { make_poisson_disk(count, 0); });
  }
}

}  // namespace
}  // namespace defray::test::poisson_disk_test
