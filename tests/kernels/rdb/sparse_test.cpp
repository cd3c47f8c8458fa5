// Tiles whose rays are found for some of their rows: which, and what lies between.
#include <algorithm>
#include <limits>

#include "chain/chain.h"
#include "faults/fault.h"
#include "lens/lens_points.h"
#include "rdb/ray_tiles.h"
#include "rdb/sparse_tiles.h"
#include "reference/twin_backend.h"
#include "support.h"

namespace defray::test::sparse_test {
namespace {

constexpr std::int32_t px = 1 << DEFRAY_COC_FRACTION_BITS;

RayPlan plan_of(bool is_sparse, RaysBy by = RaysBy::gather) {
  RayPlan plan;
  plan.lens = make_lens_points(Aperture{}, is_slow_device() ? 5 : 37);
  plan.has_spans = true;
  plan.by = by;
  if (is_sparse) plan.sparse_from = {3 * px, 6 * px};
  return plan;
}

/// CoC radii in bands of columns 64 px wide: sharp, for half of the rows, for a quarter.
Frame frame_of(Size size, std::int32_t scale = 1) {
  Frame f{size.width, size.height};
  std::vector<std::int32_t> coc;
  for (int i = 0; i < size.width * size.height; ++i) {
    coc.push_back(std::array{0, 4, -9}[i % size.width / 64 % 3] * scale * px);
  }
  f.coc_quanta = std::move(coc);
  f.depth = random_depth(size, 7);
  f.channels = std::vector<Plane>{random_plane(size, 8), random_plane(size, 9)};
  return f;
}

constexpr Size frame_size{208, 83};

bool is_between(int x, int y) {
  // Tiles at the borders of the bands of columns are next to smaller radii.
  const std::array<std::uint32_t, 13> sparsity{0, 0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 0, 0};
  const bool has_rays[2][16] = {{1, 0, 1, 0, 0, 1, 0, 1, 1, 0, 1, 0, 0, 1, 0, 1},
                                {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}};
  const std::uint32_t own = sparsity[static_cast<std::size_t>(x / 16)];
  return own > 0 && y < 80 && !has_rays[own - 1][y % 16];
}

TEST(Sparse, KeepsTheRowsThatHaveRaysAndInterpolatesTheOthers) {
  const Frame f = frame_of(frame_size);
  const RayResult all = device().rays(f, plan_of(false)), some = device().rays(f, plan_of(true));
  std::size_t between = 0, differ = 0;
  for (int y = 0; y < f.height; ++y) {
    for (int x = 0; x < f.width; ++x) {
      const std::size_t i = f.index(x, y), row = static_cast<std::size_t>(f.width);
      const float mean = some.means[1][i];
      if (!is_between(x, y)) {
        ASSERT_EQ(mean, all.means[1][i]) << x << ' ' << y;
        ASSERT_EQ(some.seen[i], all.seen[i]) << x << ' ' << y;
        continue;
      }
      ++between;
      differ += mean != all.means[1][i];
      std::size_t up = 1, down = 1;
      while (is_between(x, y - static_cast<int>(up))) ++up;
      while (is_between(x, y + static_cast<int>(down))) ++down;
      const double above = all.means[1][i - up * row], below = all.means[1][i + down * row];
      const double a = static_cast<double>(up), b = static_cast<double>(down);
      const auto expected = static_cast<float>((above * b + below * a) / (a + b));
      ASSERT_FLOAT_EQ(mean, expected) << x << ' ' << y;
    }
  }
  EXPECT_EQ(some.interpolated, between);
  EXPECT_EQ(all.interpolated, 0u);
  EXPECT_GT(differ, between / 2);
}

void expect_equal(const RayResult& a, const RayResult& b, const std::string& what) {
  EXPECT_EQ(hash_of(a.means), hash_of(b.means)) << what;
  EXPECT_EQ(a.seen, b.seen) << what;
  EXPECT_EQ(a.interpolated, b.interpolated) << what;
}

TEST(Sparse, IsTheSameForScatterBandsPassesScalarsAndTwins) {
  const Frame f = frame_of(frame_size);
  const RayResult expected = device().rays(f, plan_of(true));
  expect_equal(device().rays(f, plan_of(true, RaysBy::scatter)), expected, "scatter");
  expect_equal(reference::TwinBackend().rays(f, plan_of(true)), expected, "twins");
  for (const std::size_t kib : {1, 100, 700}) {
    const InBands bands(session(), kib << 10);
    expect_equal(device().rays(f, plan_of(true)), expected, fmt::format("{} KiB", kib));
  }
  DeviceInfo short_of_breath = device_under_test();
  short_of_breath.most_segments = 900;
  Session passes(short_of_breath);
  expect_equal(DeviceBackend(passes).rays(f, plan_of(true)), expected, "passes");
  SessionOptions options;
  options.use_vectors = false;
  options.files = {"rdb/rdb_tiles.cl", "rdb/rdb_gather.cl", "rdb/rdb_between.cl"};
  Session scalars(device_under_test(), options);
  expect_equal(DeviceBackend(scalars).rays(f, plan_of(true)), expected, "scalars");
}

/// In windows of whole tiles: what lies in the last row of the next tile counts, beyond where rays
/// come from.
TEST(Sparse, IsTheSameInWindowsBesideSmallRadii) {
  Frame f = frame_of({64, 96});
  std::vector<std::int32_t> coc(f.pixels(), 12 * px);
  for (const int y : {47, 48}) std::fill_n(coc.begin() + y * f.width, f.width, 0);
  f.coc_quanta = std::move(coc);
  RayPlan plan = plan_of(true);
  plan.sparse_from = {10 * px, 24 * px};
  const RayResult expected = device().rays(f, plan);
  EXPECT_GT(expected.interpolated, 0u);
  const InBands bands(session(), 1 << 10);
  expect_equal(device().rays(f, plan), expected, "windows of 16 rows");
}

/// Winners are kept for a row or two at once where there is little memory.
TEST(Sparse, IsTheSameBesideLampsInBandsThatCutTiles) {
  Frame f = frame_of(frame_size, 4);
  std::vector<float> bright;
  for (int i = 0; i < f.width * f.height; ++i) bright.push_back(0.2f + 0.01f * (i % 7));
  bright[f.index(170, 12)] = 900;  // of a disc that meets some tiles
  f.channels = std::vector<Plane>(3, bright);
  f.inverse = Plane(f.pixels(), 0.5f);
  ChainSettings s;
  s.hidden = Hidden::off;
  const MethodResult expected = run_chain(f, s, device(), false, {});
  EXPECT_EQ(expected.report->highlights, 1u);
  EXPECT_GT(expected.report->interpolated, 0u);
  for (const std::size_t kib : {200, 900, 3000}) {
    const InBands bands(session(), kib << 10);
    EXPECT_EQ(hash_of(run_chain(f, s, device(), false, {}).colour), hash_of(expected.colour));
  }
  s.rays = RaysBy::scatter;
  EXPECT_EQ(hash_of(run_chain(f, s, device(), false, {}).colour), hash_of(expected.colour));
  {
    const InBands bands(session(), 900 << 10);  // some of the lens's points at a time
    EXPECT_EQ(hash_of(run_chain(f, s, device(), false, {}).colour), hash_of(expected.colour));
  }
  // The lamp's light comes once rows are interpolated: the disc's edge, 3 high, has none missing.
  s.sparse = false;
  const MethodResult all_rows = run_chain(f, s, device(), false, {});
  float farthest = 0;
  for (std::size_t i = 0; i < f.pixels(); ++i) {
    farthest = std::fmax(farthest, std::fabs(all_rows.colour[0][i] - expected.colour[0][i]));
  }
  EXPECT_LT(farthest, 0.05f);
}

/// Rays are counted where they were found, and the rim leaves other points open a row farther.
TEST(Sparse, SeesNoMoreThanTheRimLeavesOpen) {
  Frame f = frame_of(frame_size, 4);
  f.coc_quanta = Quanta(std::vector<std::int32_t>(f.pixels(), -30 * px));
  f.inverse = Plane(f.pixels(), 0.5f);
  ChainSettings s;
  s.hidden = Hidden::off;
  s.highlights = false;
  s.aperture.cats_eye = 1;
  const MethodResult made = run_chain(f, s, device(), false, {});
  EXPECT_GT(made.report->interpolated, f.pixels() / 2);
  EXPECT_EQ(*std::ranges::max_element(made.confidence), 1.0f);
}

TEST(Sparse, LeavesWhatIsOfOneColourOrInfiniteAsItIs) {
  Frame f = frame_of(frame_size);
  const float infinite = std::numeric_limits<float>::infinity();
  f.channels = std::vector<Plane>{Plane(f.pixels(), 0.1f), Plane(f.pixels(), infinite),
                                  Plane(f.pixels(), std::numeric_limits<float>::max())};
  const RayResult some = device().rays(f, plan_of(true));
  EXPECT_GT(some.interpolated, 0u);
  for (const std::size_t c : {0, 1, 2}) {
    EXPECT_EQ(some.means[c], Plane(f.pixels(), f.channels[c][0]));
  }
}

// Which tiles.

constexpr TileWindow window{64, 7, 6};

std::vector<std::uint32_t> sparsity_of(std::vector<std::int32_t> least, const Frame& f,
                                       const RayPlan& plan) {
  return sparse_tiles(least, window, f, plan);
}

TEST(SparseTiles, AreAsFarFromSmallRadiiAsTheseReach) {
  const Frame f{112, 160};
  RayPlan plan;
  plan.sparse_from = {15 * px, 17 * px};
  std::vector<std::int32_t> least(7 * 6, 17 * px);
  EXPECT_EQ(sparsity_of(least, f, plan), std::vector<std::uint32_t>(42, 2));
  least[2 * 7 + 3] = 17 * px - 1;  // in row 2, column 3: as far as two tiles, for a quarter
  const auto near = sparsity_of(least, f, plan);
  least[2 * 7 + 3] = 15 * px - 1;  // one tile, for half
  const auto nearer = sparsity_of(least, f, plan);
  for (int i = 0; i < 42; ++i) {
    const int away = std::max(std::abs(i % 7 - 3), std::abs(i / 7 - 2));
    EXPECT_EQ(near[static_cast<std::size_t>(i)], away > 2 ? 2u : 1u) << i;
    EXPECT_EQ(nearer[static_cast<std::size_t>(i)], away > 2 ? 2u : away > 1 ? 1u : 0u) << i;
  }
}

TEST(SparseTiles, AreNoneWhereRowsAreNotThePicturesOrWinnersAreWanted) {
  Frame f{112, 64 + 6 * 16 - 3};
  RayPlan plan;
  const std::vector<std::int32_t> least(7 * 6, 99 * px);
  EXPECT_EQ(sparsity_of(least, f, plan), std::vector<std::uint32_t>(42, 0)) << "not asked for";
  plan.sparse_from = {10 * px, 24 * px};
  const auto rows_of = [&](const std::vector<std::uint32_t>& sparsity) {
    std::vector<std::uint32_t> column;
    for (std::size_t y = 0; y < 6; ++y) column.push_back(sparsity[y * 7]);
    return column;
  };
  EXPECT_EQ(rows_of(sparsity_of(least, f, plan)), (std::vector<std::uint32_t>{2, 2, 2, 2, 2, 0}));
  f.margin = 65;
  EXPECT_EQ(rows_of(sparsity_of(least, f, plan)), (std::vector<std::uint32_t>{0, 0, 0, 0, 0, 0}));
  f.height = 400;
  EXPECT_EQ(rows_of(sparsity_of(least, f, plan)), (std::vector<std::uint32_t>{0, 2, 2, 2, 2, 2}));
  plan.wants_nearest = true;
  EXPECT_EQ(sparsity_of(least, f, plan), std::vector<std::uint32_t>(42, 0));
}

/// A hole in front shows its own colour, whatever is around it.
TEST(SparseTiles, HaveNoHoles) {
  Frame f = frame_of(frame_size);
  std::vector<float> depth(f.depth.begin(), f.depth.end());
  depth[f.index(150, 20)] = no_fragment();
  f.depth = std::move(depth);
  const auto least = device().ray_tiles(f, plan_of(true)).least;
  EXPECT_EQ(least[1 * 13 + 150 / 16], 0);
  EXPECT_EQ(least[1 * 13 + 150 / 16 + 1], 9 * px);
}

const FaultRows faults{
    {"rdb_between",
     "weights swapped",
     {"a * (1.0f - share) + b * share", "a * share + b * (1.0f - share)"}},
    {"rdb_between", "fourth channel left", {"mean3[at] = mix_of(mean3[a], mean3[b], share);", ""}},
    {"rdb_between", "seen rounded down", {"+ (uint)rows / 2u", ""}},
    {"rdb_between", "last rows alike", {"rows == 3 ? 1.0f / 3 :", "rows == 3 ? 1.0f / 2 :"}},
    {"rdb_between", "other rows", {"j * (5 << sparsity) / 4", "j * (4 << sparsity) / 4"}},
    {"rdb_tiles", "holes in front", {"if (layer == 0u) least_found = 0;", ""}},
    {"rdb_tiles", "spans about 0", {"first <= 0 && last >= 0 ? 0 : first > 0", "first > 0"}},
};

}  // namespace
}  // namespace defray::test::sparse_test
