// Kernel rdb_gather against rdb_scatter and rdb_merge: the same bits, whatever the frame.
#include "base/random.h"
#include "chain/chain.h"
#include "device/rdb_tiles.h"
#include "lens/aperture_table.h"
#include "lens/landing_radii.h"
#include "lens/lens_points.h"
#include "rdb/rdb.h"
#include "support.h"
#include "validation/input.h"

namespace defray::test::rdb_gather_test {
namespace {

/// The picture's part of a plane of one layer.
template <typename T>
std::vector<T> cropped(std::span<const T> plane, const Frame& f) {
  std::vector<T> out;
  for (int y = f.margin; y < f.height - f.margin; ++y) {
    const auto row = plane.begin() + static_cast<std::ptrdiff_t>(y) * f.width;
    out.insert(out.end(), row + f.margin, row + f.width - f.margin);
  }
  return out;
}

RayResult rays(Backend& backend, const Frame& f, RayPlan plan, RaysBy by) {
  plan.by = by;
  return backend.rays(f, plan);
}

void expect_equal(const RayResult& a, const RayResult& b, const std::string& what) {
  EXPECT_EQ(hash_of(a.means), hash_of(b.means)) << what;
  EXPECT_EQ(a.seen, b.seen) << what;
  EXPECT_EQ(a.nearest, b.nearest) << what;
}

/// Two layers, shares, made-up fragments, gaps: as validate draws them.
Frame random_frame(Size size, double coc_px, std::uint32_t seed) {
  validation::Case c;
  c.width = size.width;
  c.height = size.height;
  c.coc_px = coc_px;
  c.pattern = validation::Pattern::steps;
  c.seed = seed;
  return validation::make_input(c).fragments;
}

RayPlan plan_of(int points, bool wants_nearest = false) {
  RayPlan plan;
  plan.lens = make_lens_points(Aperture{}, points);
  if (points % 3 == 1) plan.lens.landing_radii = landing_radii(plan.lens);
  plan.has_spans = !wants_nearest;
  plan.wants_nearest = wants_nearest;
  return plan;
}

TEST(RdbGather, GivesTheScattersBitsOnFramesOfAnySizeAndBlur) {
  for (const Size size : {Size{1, 1}, Size{1, 70}, Size{70, 1}, Size{16, 4}, Size{17, 5},
                          Size{61, 43}, Size{130, 75}}) {
    if (is_slow_device() && size.width > 70) continue;
    for (const double coc_px : {0.0, 0.4, 3.0, 30.0, 5000.0}) {
      const std::uint32_t seed = static_cast<std::uint32_t>(size.width + 7 * coc_px);
      const Frame f = random_frame(size, coc_px, seed);
      const RayPlan plan = plan_of(is_slow_device() ? 5 : 37, seed % 2 == 0);
      expect_equal(rays(device(), f, plan, RaysBy::gather),
                   rays(device(), f, plan, RaysBy::scatter),
                   fmt::format("{}x{}, CoC {} px", size.width, size.height, coc_px));
    }
  }
}

TEST(RdbGather, GivesTheSameBitsInBandsOfAnyHeightOnCopies) {
  const Frame f = random_frame({45, 90}, 6, 4);
  for (const bool wants_nearest : {false, true}) {
    const RayPlan plan = plan_of(13, wants_nearest);
    const RayResult whole = rays(device(), f, plan, RaysBy::gather);
    for (const std::size_t kib : {1, 60, 300, 900}) {
      const InBands bands(session(), kib << 10);
      expect_equal(rays(device(), f, plan, RaysBy::gather), whole, fmt::format("{} KiB", kib));
    }
  }
}

TEST(RdbGather, WindowsOfPaddedPlanesFitTheMemory) {
  const Frame f = random_frame({45, 900}, 3, 4);
  ASSERT_EQ(f.layers, 2);
  ASSERT_FALSE(f.coverage.empty());
  const RayPlan plan = plan_of(5);
  RayTileWindow window(session(), f, plan, bins_of(f));
  constexpr std::size_t words = 1 + 2 + 4;  // key; sending and coverage; channels
  const std::size_t row_bytes = std::size_t{window.params.stride} * 2 * words * 4;
  for (const std::size_t rows : {200, 400}) {
    const InBands bands(session(), 2 * rows * row_bytes);  // frames take the other half
    int most = 0;
    for (const BandRows& band : window.windows()) most = std::max(most, band.window_rows);
    EXPECT_LE(most, static_cast<int>(rows));
    EXPECT_GT(most, static_cast<int>(rows) / 2);
  }
}

TEST(RdbGather, GivesTheSameBitsOnDevicesThatPreferScalars) {
  SessionOptions options;
  options.use_vectors = false;
  options.files = {"rdb/rdb_tiles.cl", "rdb/rdb_gather.cl", "rdb/rdb_nearest.cl"};
  Session scalars(device_under_test(), options);
  EXPECT_FALSE(scalars.uses_vectors());
  EXPECT_EQ(session().uses_vectors(), device_under_test().prefers_vectors);
  DeviceBackend backend(scalars);
  const Size size{61, 43};
  const std::vector<Plane> channels(3, random_plane(size, 8));
  const Frame plain{size.width, size.height, random_coc(size, 5, 6), random_depth(size, 7),
                    channels};
  for (const Frame& f : {plain, random_frame(size, 9, 5)}) {
    const RayPlan plan = plan_of(13, f.layers > 1);
    expect_equal(rays(backend, f, plan, RaysBy::gather), rays(device(), f, plan, RaysBy::gather),
                 fmt::format("{} layers", f.layers));
  }
}

TEST(RdbGather, GivesTheSameBitsForEveryWorkGroup) {
  const Frame f = random_frame({61, 43}, 9, 5);
  const RayPlan plan = plan_of(13, true);
  const RayResult expected = rays(device(), f, plan, RaysBy::gather);
  Session s(device_under_test());
  DeviceBackend backend(s);
  for (const auto& [x, y] : {std::pair{7, 3}, {1, 16}}) {
    s.set_work_group(static_cast<std::size_t>(x), static_cast<std::size_t>(y));
    expect_equal(rays(backend, f, plan, RaysBy::gather), expected, fmt::format("{}x{}", x, y));
  }
}

/// The rest of a picture may be of one colour: what differs in one channel is a mean.
TEST(RdbGather, SeesWhatDiffersInOneChannelAlone) {
  const Size size{61, 43};
  for (std::size_t varying = 0; varying < 4; ++varying) {
    std::vector<Plane> channels(4, Plane(size.width * size.height, 0.3f));
    channels[varying] = random_plane(size, 8);
    const Frame f{size.width, size.height, random_coc(size, 5, 6), random_depth(size, 7), channels};
    const RayPlan plan = plan_of(13);
    expect_equal(rays(device(), f, plan, RaysBy::gather), rays(device(), f, plan, RaysBy::scatter),
                 fmt::format("channel {}", varying));
    EXPECT_NE(rays(device(), f, plan, RaysBy::gather).means[varying], channels[varying]);
  }
}

TEST(RdbGather, KeepsToTheRim) {
  const Frame f = random_frame({61, 43}, 9, 7);
  RayPlan plan = plan_of(37);
  for (int x = 0; x < f.width; ++x) plan.rim_x.push_back(3000 * (x - 20));
  for (int y = 0; y < f.height; ++y) plan.rim_y.push_back(-2500 * (y - 30));
  expect_equal(rays(device(), f, plan, RaysBy::gather), rays(device(), f, plan, RaysBy::scatter),
               "rim");
}

TEST(RdbGather, GivesTheSameBitsInPassesOfFewCells) {
  const Frame f = random_frame({61, 43}, 9, 5);
  RayPlan plan = plan_of(37, true);
  const RayResult expected = rays(device(), f, plan, RaysBy::gather);
  DeviceInfo short_of_breath = device_under_test();
  for (const std::size_t most : {1, 2000, 9000}) {
    short_of_breath.most_segments = most;
    Session s(short_of_breath);
    DeviceBackend backend(s);
    expect_equal(rays(backend, f, plan, RaysBy::gather), expected, fmt::format("{}", most));
  }
}

/// A frame of which only the middle is asked for, as after `border`.
TEST(RdbGather, KnowsTheMiddleOfAFrameWithAMargin) {
  Frame f = random_frame({90, 71}, 7, 10);
  const RayPlan plan = plan_of(21);
  const RayResult all = rays(device(), f, plan, RaysBy::gather);
  for (const int margin : {5, 16, 21}) {
    f.margin = margin;
    const RayResult middle = rays(device(), f, plan, RaysBy::gather);
    for (std::size_t c = 0; c < all.means.size(); ++c) {
      EXPECT_EQ(cropped<float>(middle.means[c], f), cropped<float>(all.means[c], f)) << margin;
    }
    EXPECT_EQ(cropped<std::uint32_t>(middle.seen, f), cropped<std::uint32_t>(all.seen, f));
  }
}

/// All stages, lamps among them; frames with a margin, which the light of lamps reaches.
TEST(RdbGather, GivesTheScattersBitsAtTheEndOfTheChain) {
  const Size size = is_slow_device() ? Size{30, 20} : Size{120, 90};
  Frame f{size.width, size.height};
  Plane inverse, depth;
  std::vector<std::int32_t> coc;
  std::vector<Plane> channels(4);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const bool is_near = (x / 13 + y / 17) % 2 == 0;
      Random random(x, y, 5);
      const float lamp = random.next() < 0.003 ? 50.0f : 0.0f;
      depth.push_back(is_near ? 2.0f : 9.0f);
      coc.push_back(is_near ? -1500 : 2600);
      for (Plane& channel : channels) channel.push_back(static_cast<float>(random.next()) + lamp);
    }
  }
  channels.pop_back();
  f.depth = depth;
  f.coc_quanta = coc;
  f.channels = channels;
  ChainSettings settings;
  settings.cells_per_side = 5;
  for (const double cats_eye : {0.0, 0.6}) {
    settings.aperture.cats_eye = cats_eye;
    std::vector<std::uint64_t> hashes;
    for (const RaysBy by : {RaysBy::gather, RaysBy::scatter}) {
      settings.rays = by;
      const MethodResult result = run_chain(f, settings, device(), true);
      hashes.push_back(hash_of(result.colour));
      EXPECT_GT(result.report->highlights, 5u);
      EXPECT_FALSE(result.nearest.empty());
    }
    EXPECT_EQ(hashes[0], hashes[1]) << "cat's eye " << cats_eye;
    settings.rays = RaysBy::gather;
    EXPECT_EQ(hash_of(run_chain(f, settings, device(), false).colour), hashes[0]);
  }
}

}  // namespace
}  // namespace defray::test::rdb_gather_test
