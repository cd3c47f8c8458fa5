// Frame-to-frame error against closed forms.
#include "measure/flicker.h"

#include <cmath>

#include "image/ldr.h"
#include "support.h"

namespace defray::test::flicker_test {
namespace {

std::vector<Plane> grey(double encoded) {
  return std::vector<Plane>(3, Plane(8, static_cast<float>(srgb_decode(encoded))));
}

TEST(Flicker, OfTheTruthItselfIsNone) {
  const std::vector<Plane> now = grey(0.25), next = grey(0.75);
  const Flicker f = flicker(now, next, now, next);
  EXPECT_EQ(f.error_rms, 0);
  EXPECT_NEAR(f.truth_rms, 0.5, 1e-6);
}

TEST(Flicker, ASteadyErrorIsNone) {
  const Flicker f = flicker(grey(0.5), grey(0.75), grey(0.25), grey(0.5));
  EXPECT_NEAR(f.error_rms, 0, 1e-6);
  EXPECT_NEAR(f.truth_rms, 0.25, 1e-6);
}

TEST(Flicker, IsWhatMovesBesideTheTruth) {
  // The truth rises by 0.25, the result falls by 0.125; one channel of three alone in the second.
  EXPECT_NEAR(flicker(grey(0.5), grey(0.375), grey(0.25), grey(0.5)).error_rms, 0.375, 1e-6);
  std::vector<Plane> next = grey(0.5);
  next[1] = grey(0.8)[1];
  const Flicker f = flicker(grey(0.5), next, grey(0.25), grey(0.25));
  EXPECT_NEAR(f.error_rms, 0.3 / std::sqrt(3), 1e-6);
  EXPECT_EQ(f.truth_rms, 0);
}

TEST(Flicker, IsThatOfADisplay) {
  const auto bright = [](float value) { return std::vector<Plane>(3, Plane(8, value)); };
  EXPECT_EQ(flicker(bright(1), bright(900), bright(7), bright(3)).error_rms, 0);
  EXPECT_TRUE(std::isnan(flicker(bright(1), bright(NAN), bright(1), bright(1)).error_rms));
}

TEST(Flicker, NeedsPicturesOfOneSize) {
  const std::vector<Plane> a = grey(0.5), small(3, Plane(4));
  expect_error(ErrorKind::usage, {"differ in size: 8 and 4 pixels"},
               [&] { flicker(a, small, a, a); });
  expect_error(ErrorKind::usage, {"differ in size"}, [&] { flicker(a, a, small, a); });
  expect_error(ErrorKind::usage, {"differ in size"}, [&] { flicker(a, a, a, small); });
}

}  // namespace
}  // namespace defray::test::flicker_test
