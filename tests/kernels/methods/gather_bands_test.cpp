// Gathers in bands: the same bits where memory or buffers are short.
#include <limits>
#include <set>

#include "kernels/methods/gather_support.h"
#include "opencl/bands.h"

namespace defray::test::gather_test {
namespace {

/// Where the memory holds from one row with those in reach up to a few.
TEST(Gather, SameBitsInBandsOfAnyHeight) {
  for (const Size size :
       {Size{1, 1}, {1, 37}, {37, 1}, {16, 16}, {is_slow_device() ? 17 : 67, 45}}) {
    for (const double largest : {0.0, 1.7, 8.0, 300.0}) {
      const auto coc = random_coc(size, largest, 3);
      const auto channels = planes_of(size);
      const Frame f{size.width, size.height, coc, {}, channels};
      for (const GatherKind kind : kinds) {
        const GatherSettings s = settings_of(kind, is_slow_device() ? 2 : 9, 3, true);
        const std::uint64_t expected = hash_of(render(size, coc, channels, s));
        const char* const kernel = kind == GatherKind::aware ? "gather_aware" : "gather_literal";
        for (const int rows : {1, 2, 7, 30}) {
          const InBands in_bands(session(), band_bytes(kernel, f, gather_reach_px(f), rows));
          EXPECT_EQ(hash_of(render(size, coc, channels, s)), expected)
              << kernel << ", " << size.width << "x" << size.height << ", CoC " << largest << ", "
              << rows << " rows";
        }
      }
    }
  }
}

/// Radii that end right before a whole pixel, and samples at the rim: the last rows in reach count.
TEST(Gather, BandsReadAllRowsThatSamplesReach) {
  const Size size{64, 40};
  const std::vector<std::int32_t> coc(64 * 40, 9 * 256 - 1);
  const auto channels = planes_of(size);
  const Frame f{size.width, size.height, coc, {}, channels};
  for (const GatherKind kind : kinds) {
    const GatherSettings s = settings_of(kind, is_slow_device() ? 20 : 400, 1, true);
    const std::uint64_t expected = hash_of(render(size, coc, channels, s));
    const char* const kernel = kind == GatherKind::aware ? "gather_aware" : "gather_literal";
    const InBands in_bands(session(), band_bytes(kernel, f, gather_reach_px(f), 1));
    EXPECT_EQ(hash_of(render(size, coc, channels, s)), expected) << kernel;
  }
}

TEST(Gather, SameBitsOfOneToFourChannelsInBands) {
  const Size size{33, 41};
  const auto coc = random_coc(size, 3, 3);
  const GatherSettings s = settings_of(GatherKind::aware, 5, 2, false);
  for (std::size_t count = 1; count <= 4; ++count) {
    auto channels = planes_of(size);
    channels.resize(count);
    const auto whole = render(size, coc, channels, s);
    ASSERT_EQ(whole.size(), count);
    const InBands in_bands(session(), 20000);
    EXPECT_EQ(render(size, coc, channels, s), whole);
  }
}

TEST(Gather, SameBitsWhereDevicesAllowSmallBuffersAlone) {
  const Size size{150, 140};
  const auto coc = random_coc(size, 9, 2);
  const auto channels = planes_of(size);
  const GatherSettings s = settings_of(GatherKind::aware, is_slow_device() ? 2 : 16, 2, true);
  DeviceInfo info = device_under_test();
  info.max_buffer_bytes = 150 * 140 * 16 - 1;  // what samples fetch does not fit
  Session small(info);
  const std::size_t before = small.traffic().made;
  EXPECT_EQ(
      hash_of_planes(DeviceBackend(small).gather({size.width, size.height, coc, {}, channels}, s)),
      hash_of(render(size, coc, channels, s)));
  EXPECT_GT(small.traffic().made, before);
}

TEST(Gather, RefusesMemoryThatHoldsNotEvenOneRow) {
  const Size size{40, 300};
  const auto coc = std::vector<std::int32_t>(40 * 300, 100 * 256);
  for (const GatherKind kind : kinds) {
    const GatherSettings s = settings_of(kind, 2, 1, false);
    const auto run = [&] { render(size, coc, planes_of(size), s); };
    const int reach = kind == GatherKind::literal ? 102 : 101;
    const std::size_t least = 40 * (size_t(2 * reach + 1) * 20 + 16);
    {
      const InBands in_bands(session(), least - 1);
      expect_error(ErrorKind::usage, {"memory", "one row of 40 pixels", "100 px", "MiB"}, run);
    }
    const InBands in_bands(session(), least);
    EXPECT_NO_THROW(run());
  }
}

}  // namespace
}  // namespace defray::test::gather_test
