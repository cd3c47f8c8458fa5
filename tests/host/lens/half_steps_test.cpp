// Depth in half floats: steps that show become slopes, edges stay.
#include "lens/half_steps.h"

#include <cmath>
#include <limits>

#include "defray/defray.h"
#include "support.h"

namespace defray::test::half_steps_test {
namespace {

constexpr int width = 160, height = 24;
constexpr int frame_width = 4096;  // of which this is a part

Lens telephoto() {
  Lens lens;
  lens.focal_length_mm = 300;
  lens.aperture_diameter_mm = 600;  // f/0.5
  lens.focus_distance_units = 8;
  return lens;
}

/// Rounded to eleven digits, as a half is.
float as_half(float z) {
  int exponent = 0;
  const float share = std::frexp(z, &exponent);
  return std::ldexp(std::nearbyint(std::ldexp(share, 11)), exponent - 11);
}

/// A slope from 9 on, in both directions.
Plane slope() {
  Plane z;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      z.push_back(9 + 0.0005f * static_cast<float>(x) + 0.0002f * static_cast<float>(y));
    }
  }
  return z;
}

Plane halves(Plane z) {
  for (float& value : z) value = as_half(value);
  return z;
}

TEST(HalfSteps, TerracesBecomeTheSlopeTheyWere) {
  const Plane exact = slope(), stepped = halves(exact);
  Plane z = stepped;
  const HalfSteps report = smooth_half_steps(z, width, telephoto(), frame_width);
  const float step = 1.0f / 128;
  EXPECT_GT(report.largest_px, 0.5);
  EXPECT_GT(report.smoothed, z.size() / 2);
  std::size_t changed = 0;
  for (std::size_t i = 0; i < z.size(); ++i) changed += z[i] != stepped[i] ? 1 : 0;
  EXPECT_EQ(report.smoothed, changed);
  double before = 0, after = 0;
  for (std::size_t i = 0; i < z.size(); ++i) {
    EXPECT_LE(std::fabs(z[i] - stepped[i]), step / 2);
    before = std::max(before, std::fabs(static_cast<double>(stepped[i] - exact[i])));
    const auto x = i % width;  // half terraces at the frame's ends know one step only
    if (x > 24 && x < width - 24) {
      after = std::max(after, std::fabs(static_cast<double>(z[i] - exact[i])));
    }
    if (x > 0) EXPECT_LT(std::fabs(z[i] - z[i - 1]), step / 3) << "no step is left";
  }
  EXPECT_NEAR(before, step / 2, step / 10);
  EXPECT_LT(after, 0.15 * static_cast<double>(step));
}

TEST(HalfSteps, EdgesAndWhatIsNoStepStay) {
  Plane z;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) z.push_back(x < width / 2 ? 4.0f : 9.0f);
  }
  z[5] = std::numeric_limits<float>::infinity();
  const Plane before = z;
  EXPECT_EQ(smooth_half_steps(z, width, telephoto(), frame_width).smoothed, 0u);
  EXPECT_EQ(z, before);
  // A terrace beside an edge follows its own steps, never the other side's.
  Plane mixed = halves(slope());
  for (std::size_t i = 0; i < mixed.size(); ++i) {
    if (i % width < 40) mixed[i] = 4;
  }
  const Plane stepped = mixed;
  smooth_half_steps(mixed, width, telephoto(), frame_width);
  for (std::size_t i = 0; i < mixed.size(); ++i) {
    if (i % width < 40) EXPECT_EQ(mixed[i], 4);
    EXPECT_LE(std::fabs(mixed[i] - stepped[i]), 1.0f / 256);
  }
}

/// A plane: 1/z is linear, 2 to 3 steps a pixel across and one down; from `edge` on another one.
Plane steep_planes(int edge, float other) {
  Plane z;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const float inverse =
          0.24f - 0.00028f * static_cast<float>(x) - 0.0001f * static_cast<float>(y);
      z.push_back(1 / (x < edge ? inverse : inverse * other));
    }
  }
  return z;
}

TEST(HalfSteps, SteepSlopesAreSmoothedUpToTheFramesEnds) {
  const Plane exact = steep_planes(width, 1), stepped = halves(exact);
  Plane z = stepped;
  const HalfSteps report = smooth_half_steps(z, width, telephoto(), frame_width);
  EXPECT_GT(report.smoothed, z.size() * 9 / 10);
  EXPECT_GT(report.largest_px, 0.5);
  double before = 0, after = 0;
  for (std::size_t i = 0; i < z.size(); ++i) {
    const auto step = static_cast<double>(stepped[i] < 8 ? 1.0f / 256 : 1.0f / 128);
    EXPECT_LE(std::fabs(z[i] - stepped[i]), step / 2 * 1.0001);
    before = std::max(before, std::fabs(static_cast<double>(stepped[i] - exact[i])) / step);
    after = std::max(after, std::fabs(static_cast<double>(z[i] - exact[i])) / step);
  }
  EXPECT_GT(before, 0.45);
  EXPECT_LT(after, 0.25);
}

TEST(HalfSteps, NoSlopeGoesOnAcrossAnEdge) {
  constexpr int edge = 70;
  Plane near = halves(steep_planes(edge, 1.5f)), far = halves(steep_planes(edge, 0.6f));
  Plane thin = near;  // of a pixel's width, in front
  for (int y = 0; y < height; ++y) thin[static_cast<std::size_t>(y * width + 30)] = 3;
  for (Plane* z : {&near, &far, &thin}) smooth_half_steps(*z, width, telephoto(), frame_width);
  for (std::size_t i = 0; i < near.size(); ++i) {
    if (i % width < edge) EXPECT_EQ(near[i], far[i]) << i % width;
    if (i % width == 30) EXPECT_EQ(thin[i], 3);
  }
}

TEST(HalfSteps, NothingIsDoneWhereNoStepShows) {
  Plane z = halves(slope());
  const Plane before = z;
  Lens small = telephoto();
  small.aperture_diameter_mm = 2;
  const HalfSteps report = smooth_half_steps(z, width, small, frame_width);
  EXPECT_GT(report.largest_px, 0);
  EXPECT_LT(report.largest_px, 0.5);
  EXPECT_EQ(z, before);
  Plane floats = slope();  // not halves at all
  EXPECT_EQ(smooth_half_steps(floats, width, telephoto(), frame_width).largest_px, 0);
  EXPECT_EQ(floats, slope());
}

TEST(HalfSteps, ARangeOrAnInfiniteFocusHasStepsToo) {
  Lens lens = telephoto();
  lens.focus_distance_units = std::numeric_limits<double>::infinity();
  Plane z = halves(slope());
  const HalfSteps report = smooth_half_steps(z, width, lens, frame_width);
  // A F / 2 (1/z - 1/next)
  const double expected = 0.5 * 0.6 * frame_width * 300 / 36 * (1 / 9.0 - 1 / (9 + 1.0 / 128));
  EXPECT_NEAR(report.largest_px, expected, 0.02 * expected);
}

}  // namespace
}  // namespace defray::test::half_steps_test
