// Depth in half floats: steps that show become slopes, edges stay.
#include "lens/depth_steps.h"

#include <cmath>
#include <limits>

#include "defray/defray.h"
#include "lens/depth.h"
#include "support.h"

namespace defray::test::depth_steps_test {
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

DepthSteps smooth_halves(Plane& z, const Lens& lens = telephoto()) {
  DepthLadder ladder = ladder_of_stored(z, 0, {});
  if (!ladder.steps.empty()) convert(ladder, {});
  return smooth_steps(z, ladder, width, lens, frame_width);
}

TEST(DepthSteps, TerracesBecomeTheSlopeTheyWere) {
  const Plane exact = slope(), stepped = halves(exact);
  Plane z = stepped;
  const DepthSteps report = smooth_halves(z);
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

TEST(DepthSteps, EdgesAndWhatIsNoStepStay) {
  Plane z;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) z.push_back(x < width / 2 ? 4.0f : 9.0f);
  }
  z[5] = std::numeric_limits<float>::infinity();
  const Plane before = z;
  EXPECT_EQ(smooth_halves(z).smoothed, 0u);
  EXPECT_EQ(z, before);
  // A terrace beside an edge follows its own steps, never the other side's.
  Plane mixed = halves(slope());
  for (std::size_t i = 0; i < mixed.size(); ++i) {
    if (i % width < 40) mixed[i] = 4;
  }
  const Plane stepped = mixed;
  smooth_halves(mixed);
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

TEST(DepthSteps, SteepSlopesAreSmoothedUpToTheFramesEnds) {
  const Plane exact = steep_planes(width, 1), stepped = halves(exact);
  Plane z = stepped;
  const DepthSteps report = smooth_halves(z);
  EXPECT_GT(report.smoothed, z.size() * 9 / 10);
  EXPECT_GT(report.largest_px, 0.5);
  double before = 0, after = 0;
  for (std::size_t i = 0; i < z.size(); ++i) {
    const auto step = static_cast<double>(stepped[i] < 8 ? 1.0f / 256 : 1.0f / 128);
    // Half a step of 1 / depth.
    EXPECT_LE(std::fabs(z[i] - stepped[i]), step / 2 / (1 - step / (2 * stepped[i])) + 5e-7)
        << "and a float's rounding";
    before = std::max(before, std::fabs(static_cast<double>(stepped[i] - exact[i])) / step);
    after = std::max(after, std::fabs(static_cast<double>(z[i] - exact[i])) / step);
  }
  EXPECT_GT(before, 0.45);
  EXPECT_LT(after, 0.25);
}

TEST(DepthSteps, NoSlopeGoesOnAcrossAnEdge) {
  constexpr int edge = 70;
  Plane near = halves(steep_planes(edge, 1.5f)), far = halves(steep_planes(edge, 0.6f));
  Plane thin = near;  // of a pixel's width, in front
  for (int y = 0; y < height; ++y) thin[static_cast<std::size_t>(y * width + 30)] = 3;
  for (Plane* z : {&near, &far, &thin}) smooth_halves(*z);
  for (std::size_t i = 0; i < near.size(); ++i) {
    if (i % width < edge) EXPECT_EQ(near[i], far[i]) << i % width;
    if (i % width == 30) EXPECT_EQ(thin[i], 3);
  }
}

/// A plane stored in 256 steps, as each kind of depth means them.
TEST(DepthSteps, WholeNumbersBecomeTheSlopeTheyWere) {
  struct Case {
    DepthKind kind;
    bool invert;
  };
  for (const Case& c : {Case{DepthKind::normalized, false},
                        {DepthKind::normalized, true},
                        {DepthKind::zbuffer, false},
                        {DepthKind::zbuffer, true}}) {
    DepthSettings settings;
    settings.kind = c.kind;
    settings.invert = c.invert;
    settings.near_units = 4;
    settings.far_units = 12;
    Plane stored, exact;
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const float zbuffer = (static_cast<float>(x) + 0.3f * static_cast<float>(y)) / 180;
        const float z = 1 / ((1 - zbuffer) / 4 + zbuffer / 12);
        const float share = c.kind == DepthKind::zbuffer ? zbuffer : (z - 4) / 8;
        stored.push_back(std::nearbyint((c.invert ? 1 - share : share) * 255) / 255);
        exact.push_back(z);
      }
    }
    stored[7] = std::numeric_limits<float>::quiet_NaN();
    DepthLadder ladder = ladder_of_stored(stored, 8, settings);
    ASSERT_EQ(ladder.steps.size(), stored.size());
    EXPECT_EQ(ladder.steps[7], DepthLadder::no_step);
    const Window frame{0, 0, width, height};
    convert_depth(stored, settings, frame, frame, 0, "");
    const Plane before = stored;
    convert(ladder, settings);
    const DepthSteps report = smooth_steps(stored, ladder, width, telephoto(), frame_width);
    EXPECT_GT(report.smoothed, stored.size() / 4);
    double stepped = 0, smoothed = 0;
    for (std::size_t i = 0; i < stored.size(); ++i) {
      if (i == 7) continue;
      const auto off = [&](const Plane& z) {
        return std::fabs(1 / static_cast<double>(z[i]) - 1 / static_cast<double>(exact[i]));
      };
      stepped += off(before);
      smoothed += off(stored);
    }
    EXPECT_LT(smoothed, 0.5 * stepped) << static_cast<int>(c.kind) << c.invert;
    EXPECT_TRUE(std::isinf(stored[7]));
  }
}

TEST(DepthSteps, DistancesKeepTheirShare) {
  Plane z = halves(slope());
  const Plane before = z;
  DepthSettings settings;
  settings.kind = DepthKind::distance;
  DepthLadder ladder = ladder_of_stored(z, 0, settings);
  convert(ladder, settings);
  for (float& value : z) value *= 0.9f;
  Plane planar = before;
  smooth_steps(z, ladder, width, telephoto(), frame_width);
  smooth_halves(planar);
  EXPECT_NE(planar, before);
  for (std::size_t i = 0; i < z.size(); ++i) EXPECT_NEAR(z[i], 0.9f * planar[i], 2e-6f);
}

TEST(DepthSteps, HalvesOfEachSignAndSizeAreFound) {
  const auto steps = [](const Plane& stored, const DepthSettings& settings = {}) {
    return ladder_of_stored(stored, 0, settings).steps;
  };
  constexpr std::int32_t none = DepthLadder::no_step;
  EXPECT_EQ(steps({1, 1.5f, 65503, 0x1p-24f, 0x1.8p-15f}).size(), 0u) << "65503 is no half";
  EXPECT_EQ(steps({1, 0x1p-24f, 0x1.8p-15f, 65472}), (std::vector{0x3c00, 1, 0x300, 0x7bfe}));
  for (const float more : {1.0001f, 65536.0f, 0x1p-25f}) {
    EXPECT_TRUE(steps({1, more}).empty()) << more;
  }
  // What means that there is nothing is no half, and keeps no other from being one.
  EXPECT_EQ(steps({1, 65504, 1e10f, -1, 0}), (std::vector{0x3c00, none, none, none, none}));
  DepthSettings settings;
  settings.background = -1.0001;
  EXPECT_EQ(steps({1, -1.0001f}, settings), (std::vector{0x3c00, none}));
  settings = {};
  settings.kind = DepthKind::negative_z;
  EXPECT_EQ(steps({-1, 2}, settings), (std::vector{0x3c00, none}));
  settings.kind = DepthKind::normalized;  // out of its range, if a number
  EXPECT_TRUE(steps({0.5f, -1e30f}, settings).empty());
  settings.kind = DepthKind::negative_z;
  const DepthLadder minus = ladder_of_stored({-1, -1.5f}, 0, settings);
  EXPECT_EQ(minus.depths.back(), -1.5f - 1.0f / 1024);
}

TEST(DepthSteps, AStatedBackgroundIsNoStepAndStopsNone) {
  Plane stored = halves(slope());
  for (const double background : {-1.0, 65504.0, 1234567.0}) {
    stored[5] = static_cast<float>(background);
    DepthSettings settings;
    settings.background = background;
    DepthLadder ladder = ladder_of_stored(stored, 0, settings);
    Plane z = stored;
    const Window frame{0, 0, width, height};
    convert_depth(z, settings, frame, frame, 0, "");
    convert(ladder, settings);
    EXPECT_GT(smooth_steps(z, ladder, width, telephoto(), frame_width).smoothed, z.size() / 2);
    EXPECT_TRUE(std::isinf(z[5])) << background;
  }
}

TEST(DepthSteps, NothingIsDoneWhereNoStepShows) {
  Plane z = halves(slope());
  const Plane before = z;
  Lens small = telephoto();
  small.aperture_diameter_mm = 2;
  const DepthSteps report = smooth_halves(z, small);
  EXPECT_GT(report.largest_px, 0);
  EXPECT_LT(report.largest_px, 0.5);
  EXPECT_EQ(z, before);
  Plane floats = slope();  // not halves at all
  EXPECT_EQ(smooth_halves(floats).largest_px, 0);
  EXPECT_EQ(floats, slope());
}

TEST(DepthSteps, ARangeOrAnInfiniteFocusHasStepsToo) {
  Lens lens = telephoto();
  lens.focus_distance_units = std::numeric_limits<double>::infinity();
  Plane z = halves(slope());
  const DepthSteps report = smooth_halves(z, lens);
  // A F / 2 (1/z - 1/next)
  const double expected = 0.5 * 0.6 * frame_width * 300 / 36 * (1 / 9.0 - 1 / (9 + 1.0 / 128));
  EXPECT_NEAR(report.largest_px, expected, 0.02 * expected);
}

}  // namespace
}  // namespace defray::test::depth_steps_test
