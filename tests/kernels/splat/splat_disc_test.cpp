// Kernel splat_project: discs, which are what the lens sees of a surface.
#include <cmath>

#include "splat_support.h"

namespace defray::test::splat_disc_test {
namespace {

/// An even disc of this radius, blurred by a Gaussian of this variance that is lowered to end at 0
/// where it is down to e^-2.5; the sum is 1.
std::vector<double> blurred_disc(int side, double radius, double variance) {
  const int reach = static_cast<int>(std::ceil(std::sqrt(5 * variance)));
  std::vector<double> out(size(side * side)), row(size(side));
  double whole = 0;
  for (int dy = -reach; dy <= reach; ++dy) {
    for (int dx = -reach; dx <= reach; ++dx) {
      const double height =
          std::max(std::exp(-(dx * dx + dy * dy) / (2 * variance)) - std::exp(-2.5), 0.0);
      if (height == 0) continue;
      for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
          const double from = std::hypot(x + 0.5 - side / 2.0 - dx, y + 0.5 - side / 2.0 - dy);
          const double inside = height * std::clamp(radius - from + 0.5, 0.0, 1.0);
          out[size(y * side + x)] += inside;
          whole += inside;
        }
      }
    }
  }
  for (double& value : out) value /= whole;
  return out;
}

TEST(SplatProject, DiscsAreWhatThePrefilterLeavesOfAnEvenDisc) {
  for (const double aperture : {80.0, 160.0, 500.0}) {
    DefraySplatParams p = view_of(256, 4, aperture);
    const double coc = std::abs(splat_coc_px(p, 2));
    const int side = 2 * static_cast<int>(coc + 6);
    p.width = p.height = word(side);
    p.centre_x = p.centre_y = static_cast<float>(side) / 2;
    const double area = 1e-4;
    const DefraySplat s = project(surfel(0, 0, 2, {0, 0, area}, 1e-9), p);
    ASSERT_GT(s.disc_top, 0) << coc;
    const Plane alpha = device().splat_resolve({{s}, {}}, p).colour[3];
    const std::vector<double> exact = blurred_disc(side, coc, 1);
    const double covers = area * p.focal_px * p.focal_px / 4;  // px, at distance 2
    double sum = 0, wrong = 0, all = 0;
    for (std::size_t i = 0; i < alpha.size(); ++i) {
      const double value = alpha[i] / covers;
      sum += value;
      wrong += (value - exact[i]) * (value - exact[i]);
      all += exact[i] * exact[i];
    }
    EXPECT_NEAR(sum, 1, 2e-3) << coc;
    EXPECT_LT(std::sqrt(wrong / all), 0.035) << coc;
  }
  // Nearly in focus a Gaussian is nearer.
  EXPECT_EQ(project(surfel(0, 0, 0.1, {0, 0, 1e-6}, 1e-9), view_of(256, 4, 80)).disc_top, 0);
}

TEST(SplatProject, ASlantedDiscLeansTowardsWhereTheLensSeesMoreOfIt) {
  // At distance 2 before the focus at 4, turned by 60 degrees about y: how much of it a lens point
  // sees, over the centre.
  const DefraySplatParams p = view_of(256, 4, 500);
  const double normal[] = {std::sin(M_PI / 3), 0, std::cos(M_PI / 3)}, coc = splat_coc_px(p, 2);
  const DefraySplat s = project(surfel(0, 0, 2, {normal[0] * 1e-6, 0, normal[2] * 1e-6}, 1e-12), p);
  const double of_rim = 0.25;  // m to the right
  const double more = (of_rim * normal[0] + 2 * normal[2]) / (2 * normal[2]);
  // Before the focus what the right side sees goes to the left.
  EXPECT_NEAR(1 + coc * static_cast<double>(s.lean_x) / static_cast<double>(s.amplitude), more,
              2e-3);
  EXPECT_NEAR(s.lean_y, 0, 1e-6 * std::abs(static_cast<double>(s.lean_x)));
  // Turned by 95 degrees the centre sees it from behind, part of the lens does not.
  const auto turned = [&](double degrees) {
    const double turn = degrees / 180 * M_PI;
    return project(surfel(0, 0, 2, {1e-6 * std::sin(turn), 0, 1e-6 * std::cos(turn)}, 1e-12), p);
  };
  EXPECT_FALSE(is_culled(turned(95)));
  EXPECT_LT(turned(95).amplitude, 0);
  EXPECT_TRUE(is_culled(turned(100)));  // tan 8 degrees: 0.25 / 2
}

}  // namespace
}  // namespace defray::test::splat_disc_test
