// Kernel repair: pixels of anti-aliased depth, and whose surface they are on.
#include <algorithm>
#include <cmath>

#include "faults/fault.h"
#include "stages_support.h"

namespace defray::test::repair_test {
namespace {

constexpr int side = 21;

/// CoC of two surfaces, 0 and 1024 quanta, parted by a line across (dx, dy) through the middle,
/// `offset_px` away; over `width_px` around it depth is anti-aliased.
std::vector<std::int32_t> step_along(int dx, int dy, double width_px, double offset_px, int sign) {
  std::vector<std::int32_t> coc;
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const double along = ((x - side / 2) * dx + (y - side / 2) * dy) / std::hypot(dx, dy);
      const double from_line = along - offset_px;
      const double share = width_px > 0 ? std::clamp(0.5 + from_line / width_px, 0.0, 1.0)
                                        : (from_line > 0 ? 1.0 : 0.0);
      coc.push_back(sign * static_cast<std::int32_t>(1024 * share));
    }
  }
  return coc;
}

/// An eighth of the step: as good as on the surface.
bool is_close(int a, int b) { return std::abs(a - b) <= 1024 / 8; }

/// What `repair` says of a frame of these radii, of one depth and colour.
Words ramps_of(const std::vector<std::int32_t>& coc) {
  const Plane plane(coc.size(), 1.0f);
  return device().repair({side, side, coc, plane, {plane}});
}

/// Where the surface lies that a pixel is to be on, its own but for ramps.
std::size_t source_of(std::size_t pixel, std::uint32_t ramp) {
  if (ramp == 0) return pixel;
  const int step = static_cast<int>(ramp & ~DEFRAY_RAMP_MIXES) - 1;
  const int x = static_cast<int>(pixel) % side + step % 5 - 2;
  const int y = static_cast<int>(pixel) / side + step / 5 - 2;
  return static_cast<std::size_t>(y * side + x);
}

/// Number of pixels that were on neither surface, and now are on one.
int expect_ramp_repaired(const std::vector<std::int32_t>& coc) {
  const Words said = ramps_of(coc);
  int ramps = 0;
  for (int y = 4; y < side - 4; ++y) {
    for (int x = 4; x < side - 4; ++x) {
      const auto i = static_cast<std::size_t>(y * side + x);
      const int before = std::abs(coc[i]), after = std::abs(coc[source_of(i, said[i])]);
      EXPECT_TRUE(is_close(after, 0) || is_close(after, 1024)) << x << " " << y << ": " << after;
      if (!is_close(before, 512)) {  // the nearer one
        EXPECT_EQ(after > 512, before > 512) << x << " " << y;
      }
      if (before == 0 || before == 1024) {
        EXPECT_EQ(said[i], 0u);
      }
      ramps += !is_close(before, 0) && !is_close(before, 1024);
    }
  }
  return ramps;
}

TEST(Repair, AntiAliasedDepthIsPutOnOneOfTheTwoSurfaces) {
  for (const auto& [dx, dy] : {std::pair{1, 0}, {0, 1}, {1, 1}, {1, -1}, {-1, 0}, {-1, -1}}) {
    for (const double width_px : {1.0, 1.5, 2.0}) {
      for (const double offset_px : {0.0, 0.25, -0.25, 0.5}) {
        for (const int sign : {1, -1}) {
          SCOPED_TRACE(fmt::format("({}, {}), {} px at {}", dx, dy, width_px, offset_px));
          const int ramps = expect_ramp_repaired(step_along(dx, dy, width_px, offset_px, sign));
          const bool is_on_pixel_border = width_px == 1 && offset_px == 0.5 && dx * dy == 0;
          EXPECT_EQ(ramps > 0, !is_on_pixel_border);
        }
      }
    }
  }
}

TEST(Repair, SharpEdgesSlopesAndSmallStepsStay) {
  const auto expect_untouched = [](const std::vector<std::int32_t>& coc) {
    EXPECT_EQ(ramps_of(coc), Words(coc.size()));
  };
  for (const auto& [dx, dy] : {std::pair{1, 0}, {0, 1}, {1, 1}, {1, -1}}) {
    expect_untouched(step_along(dx, dy, 0, 0.25, 1));
    auto small = step_along(dx, dy, 1, 0, 1);
    for (std::int32_t& c : small) c /= 2;  // 512 quanta: not above a ramp's
    expect_untouched(small);
    std::vector<std::int32_t> slope;
    for (int i = 0; i < side * side; ++i)
      slope.push_back(700 * (dx * (i % side) + dy * (i / side)));
    // At the frame's edge a slope's end cannot be told from a flat surface's.
    const Words said = ramps_of(slope);
    for (int y = 4; y < side - 4; ++y) {
      for (int x = 4; x < side - 4; ++x) {
        EXPECT_EQ(said[static_cast<std::size_t>(y * side + x)], 0u);
      }
    }
  }
}

/// Whether the middle of three pixels between two surfaces is said to be a mean, by its depth and
/// its colour; the first two are of the surface at depth 2, the last two of that at 6.
bool is_mean(float depth, const std::vector<float>& low, const std::vector<float>& own,
             const std::vector<float>& high) {
  const std::vector<std::int32_t> coc{-2048, -2048, -1024, 1024, 1024};
  Planes channels;
  for (std::size_t c = 0; c < low.size(); ++c) {
    channels.emplace_back(std::vector<float>{low[c], low[c], own[c], high[c], high[c]});
  }
  const Frame f{5, 1, coc, {2, 2, depth, 6, 6}, channels};
  const Words said = device().repair(f);
  EXPECT_EQ(said, twins().repair(f));
  EXPECT_EQ(said[2] & ~DEFRAY_RAMP_MIXES, 1u + (2 - 1) + 5 * 2) << "the pixel before it";
  return (said[2] & DEFRAY_RAMP_MIXES) != 0;
}

TEST(Repair, AMeanIsCloserToTheSharesOfDepthThanToEitherSurface) {
  const std::vector<float> dark{0.1f, 0.2f, 0.1f}, light{0.9f, 0.6f, 0.5f};
  const auto between = [&](float share) {
    std::vector<float> colour;
    for (std::size_t c = 0; c < 3; ++c) colour.push_back(dark[c] + share * (light[c] - dark[c]));
    return colour;
  };
  EXPECT_TRUE(is_mean(3, dark, between(0.25f), light));  // the mean of depth
  EXPECT_TRUE(is_mean(3, dark, between(0.5f), light));   // of 1/depth
  EXPECT_TRUE(is_mean(3, dark, between(0.73f), light));
  EXPECT_FALSE(is_mean(3, dark, between(0.77f), light));  // closer to light than to a half
  EXPECT_TRUE(is_mean(3, dark, between(0.14f), light));
  EXPECT_FALSE(is_mean(3, dark, between(0.12f), light));  // closer to dark than to a quarter
  EXPECT_FALSE(is_mean(3, dark, dark, light));
  EXPECT_FALSE(is_mean(3, dark, light, light));
  EXPECT_FALSE(is_mean(3, dark, {0.05f, 0.1f, 0.05f}, light)) << "darker than both";
  EXPECT_FALSE(is_mean(3, dark, dark, dark)) << "says nothing";
}

TEST(Repair, TheLastChannelCountsAndWhatIsNotFiniteIsNoMean) {
  const std::vector<float> clear{0.2f, 0.2f, 0.2f, 0}, opaque{0.2f, 0.2f, 0.2f, 1};
  EXPECT_TRUE(is_mean(4, clear, {0.2f, 0.2f, 0.2f, 0.5f}, opaque));
  for (const float odd : {std::nanf(""), HUGE_VALF}) {
    EXPECT_FALSE(is_mean(4, clear, {odd, 0.2f, 0.2f, 0.5f}, opaque));
    EXPECT_FALSE(is_mean(4, {odd, 0.2f, 0.2f, 0}, {0.2f, 0.2f, 0.2f, 0.5f}, opaque));
    EXPECT_FALSE(is_mean(odd, clear, {0.2f, 0.2f, 0.2f, 0.5f}, opaque));
  }
}

const FaultRows faults{
    {"repair",
     "the other end of the ramp",
     {"to_high ? line.back : line.ahead", "to_high ? line.ahead : line.back"}},
    {"repair", "ties to the far end", {"to_low <= to_high ?", "to_low < to_high ?"}},
    {"repair", "falling ramps forgotten", {"rise = apart(high, low)", "rise = high - low"}},
    {"repair",
     "slopes taken for ramps",
     {"apart(low, before) < eighth & apart(after, high) < eighth", "(int16)(-1)"}},
    {"repair",
     "as good as on a surface, and moved to it",
     {"min(low, high) + eighth", "min(low, high) + rise / 16"}},
    {"repair",
     "ramps of three jumps are level",
     {"largest <= (int16)(DEFRAY_RAMP_QUANTA / 2)",
      "largest <= (int16)(3 * DEFRAY_RAMP_QUANTA / 2)"}},
    {"repair",
     "CoC without its limit",
     {"return tame(coc_quanta[pixel]);", "return coc_quanta[pixel];"}},
    {"repair", "only ramps of one pixel", {"for (int i = 15; i >= 0", "for (int i = 3; i >= 0"}},
    {"repair",
     "last ramp found counts",
     {"for (int i = 15; i >= 0; --i)", "for (int i = 0; i < 16; ++i)"}},
    {"repair", "diagonal along x alone", {"(int2)(1, -1)}", "(int2)(1, 0)}"}},
    {"repair", "anti-diagonal the wrong way", {"(int2)(1, -1)}", "(int2)(1, 1)}"}},
    {"repair", "flatness beyond one end only", {"& apart(after, high) < eighth", ""}},
    {"repair", "flatness before one end only", {"apart(low, before) < eighth & ", ""}},
    {"repair", "beyond the higher end", {"& own < max(low, high) - eighth", ""}},
    {"repair",
     "steps of two pixels are steep",
     {"rise > (int16)(DEFRAY_RAMP_QUANTA)", "rise >= (int16)(DEFRAY_RAMP_QUANTA)"}},
    {"repair",
     "without a frame's edge pixels beyond it",
     {"clamp(at.y, 0, (int)height - 1)",
      "clamp(at.y, 0, (int)height - 2 > 0 ? (int)height - 2 : 0)"}},
    {"repair",
     "all are means",
     {"own, high) ? DEFRAY_RAMP_MIXES : 0u", "own, high) ? DEFRAY_RAMP_MIXES : DEFRAY_RAMP_MIXES"}},
    {"repair", "none is a mean", {"own, high) ? DEFRAY_RAMP_MIXES : 0u", "own, high) ? 0u : 0u"}},
    {"repair",
     "means of depth alone",
     {"|| (of_inverse < to_low &&", "|| (of_inverse < -to_low &&"}},
    {"repair",
     "means of 1/depth alone",
     {"(of_depth < to_low && of_depth", "(of_depth < -to_low && of_depth"}},
    {"repair",
     "closer than to one of them",
     {"of_depth < to_low && of_depth < to_high", "of_depth < to_low"}},
    {"repair", "closer than to the other", {"of_inverse < to_low && of_inverse", "of_inverse"}},
    {"repair", "the other share", {"high] / depth_units[own]", "low] / depth_units[own]"}},
    {"repair",
     "share the wrong way",
     {"from_low - share * step", "from_low - (1.0f - share) * step"}},
    {"repair", "three channels", {"+ squares[2] + squares[3]", "+ squares[2]"}},
    {"repair", "as of a pixel to the right", {"(2 + end.x)", "(3 + end.x)"}},
    {"repair",
     "rows and columns swapped",
     {"(2 + end.x) + 5 * (2 + end.y)", "(2 + end.y) + 5 * (2 + end.x)"}},
    {"repair",
     "stale output",
     {"start, (int16)(0));",
      "start, ints_of_run(p.width, p.height, (__global const int*)ramps, start));"}},
};

}  // namespace
}  // namespace defray::test::repair_test
