// The table of segments: radius by radius, where a ray lands.
#include "rdb/segments.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "lens/landing_radii.h"
#include "lens/lens_points.h"

namespace defray::test::segments_test {
namespace {

constexpr std::size_t plenty = std::size_t{1} << 30;

/// As which radius a small one's rays land.
std::int64_t lands_as(const LensPoints& lens, std::int64_t radius) {
  if (lens.landing_radii.empty() || std::abs(radius) >= 256) return radius;
  const std::int64_t as = lens.landing_radii[static_cast<std::size_t>(std::abs(radius))];
  return radius < 0 ? -as : as;
}

/// The definition: the one d with d - r u in [-1/2, 1/2), px.
int landing(const LensPoints& lens, std::int64_t radius, std::int32_t u) {
  const double ray = std::ldexp(static_cast<double>(lands_as(lens, radius) * u), -24);  // exact
  return static_cast<int>(std::ceil(ray - 0.5));
}

/// The segment of a cell in which a radius lies, null if there is none.
const Segment* find(const SegmentTable& table, std::size_t cell, std::int64_t radius) {
  const auto begin = static_cast<std::size_t>(table.first[cell * (DEFRAY_RAY_BINS + 1)]);
  const auto end =
      static_cast<std::size_t>(table.first[cell * (DEFRAY_RAY_BINS + 1) + DEFRAY_RAY_BINS]);
  for (std::size_t i = begin; i < end; ++i) {
    const Segment& s = table.segments[i];
    if (s[2] <= radius && radius - s[2] <= static_cast<std::uint32_t>(s[3])) return &s;
  }
  return nullptr;
}

struct Range {
  std::int32_t least, largest;
};

/// Radii of a range, of all sizes.
void expect_segments_to_say_where_rays_land(const LensPoints& lens) {
  std::mt19937 random(3);
  for (const Range range : {Range{-900, 2000}, Range{-256, 256}, Range{0, 0}, Range{-130, -1},
                            Range{70, 255}, Range{-70000, -300}, Range{-(1 << 30), 1 << 30}}) {
    const RadiusBins bins(range.least, range.largest, 40);
    const SegmentTable table(lens, 0, bins, 40, 23, plenty);
    std::uniform_int_distribution<std::int32_t> any(range.least, range.largest);
    std::uniform_int_distribution<std::int32_t> near(std::max(range.least, -20000),
                                                     std::min(range.largest, 20000));
    for (int i = 0; i < 4000; ++i) {
      const auto cell = static_cast<std::size_t>(i) % lens.points.size();
      const std::int32_t radius = i % 2 ? any(random) : near.min() <= near.max() ? near(random) : 0;
      const int dx = landing(lens, radius, lens.points[cell][0]);
      const int dy = landing(lens, radius, lens.points[cell][1]);
      const Segment* s = find(table, cell, radius);
      const bool stays = std::abs(dx) < 40 && std::abs(dy) < 23;
      ASSERT_EQ(s != nullptr, stays) << radius << " of cell " << cell;
      if (s) {
        EXPECT_EQ((std::array{(*s)[0], (*s)[1]}), (std::array{dx, dy})) << radius;
      }
    }
  }
}

TEST(Segments, EveryRadiusLandsWhereItsSegmentSays) {
  expect_segments_to_say_where_rays_land(make_lens_points(Aperture{}, 37));
}

TEST(Segments, SmallRadiiLandAsOthersDo) {
  for (const int points : {1, 2, 37, 137}) {
    LensPoints lens = make_lens_points(Aperture{}, points);
    lens.landing_radii = landing_radii(lens);
    expect_segments_to_say_where_rays_land(lens);
  }
}

TEST(Segments, AscendWithoutGapsAndBeginWhereTheirBinDoes) {
  LensPoints lens = make_lens_points(Aperture{}, 21);
  lens.landing_radii = landing_radii(lens);
  const RadiusBins bins(-3000, 5000, 1000);
  const SegmentTable table(lens, 0, bins, 1000, 1000, plenty);
  for (std::size_t cell = 0; cell < lens.points.size(); ++cell) {
    const std::int32_t* first = &table.first[cell * (DEFRAY_RAY_BINS + 1)];
    EXPECT_EQ(table.segments[static_cast<std::size_t>(first[0])][2], -3000);
    for (int i = first[0] + 1; i < first[DEFRAY_RAY_BINS]; ++i) {
      const Segment& before = table.segments[static_cast<std::size_t>(i) - 1];
      EXPECT_EQ(before[2] + before[3] + 1, table.segments[static_cast<std::size_t>(i)][2]);
    }
    for (int b = 0; b < DEFRAY_RAY_BINS; ++b) {
      if (bins.first_radius(b) > 5000) continue;
      const Segment& s = table.segments[static_cast<std::size_t>(first[b])];
      EXPECT_LE(s[2], std::max<std::int64_t>(bins.first_radius(b), -3000)) << b;
      EXPECT_GE(s[2] + s[3], bins.first_radius(b)) << b;
    }
  }
}

TEST(Segments, ComeInPassesOfNoMoreThanAllowed) {
  const LensPoints lens = make_lens_points(Aperture{}, 21);
  const RadiusBins bins(-3000, 5000, 1000);
  const SegmentTable all(lens, 0, bins, 1000, 1000, plenty);
  EXPECT_EQ(all.cell_count(), 21);
  for (const std::size_t most : {std::size_t{1}, std::size_t{150}, all.segments.size() - 1}) {
    std::vector<Segment> together;
    int passes = 0;
    for (int cell = 0; cell < 21; ++passes) {
      const SegmentTable table(lens, cell, bins, 1000, 1000, most);
      ASSERT_GE(table.cell_count(), 1);
      if (table.cell_count() > 1) {
        EXPECT_LE(table.segments.size(), most);
      }
      EXPECT_EQ(static_cast<std::size_t>(table.first.back()), table.segments.size());
      together.insert(together.end(), table.segments.begin(), table.segments.end());
      cell += table.cell_count();
    }
    EXPECT_EQ(together, all.segments);
    EXPECT_GT(passes, 1);
  }
}

TEST(RadiusBins, HoldAllRadiiOfAFrameOnce) {
  for (const Range range : {Range{-300, 500}, Range{7, 7}, Range{-(1 << 30), 1 << 30},
                            Range{-5, 1 << 29}, Range{-90000, -80000}}) {
    const RadiusBins bins(range.least, range.largest, 200);
    EXPECT_LE(bins.first_radius(0), range.least);
    EXPECT_GE(bins.largest_of(DEFRAY_RAY_BINS - 1), range.largest);
    for (int b = 1; b < DEFRAY_RAY_BINS; ++b) {
      EXPECT_LT(bins.first_radius(b - 1), bins.first_radius(b));
      EXPECT_GE(bins.largest_of(b), std::abs(bins.first_radius(b)));
      EXPECT_GE(bins.largest_of(b - 1), std::abs(bins.first_radius(b) - 1));
    }
  }
  // No finer than they must be, no coarser than the frame's radii need.
  EXPECT_EQ(RadiusBins(-100, 100, 1000).shift, 0);
  EXPECT_EQ(RadiusBins(-1000, 1000, 1000).shift, 3);
  EXPECT_EQ(RadiusBins(-(1 << 30), 1 << 30, 100).shift, 8) << "what leaves the frame needs none";
}

}  // namespace
}  // namespace defray::test::segments_test
