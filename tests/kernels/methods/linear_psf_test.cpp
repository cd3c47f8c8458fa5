// Kernel linear_psf and its twin: bits, energy, and what must not leak.
#include <cmath>
#include <limits>
#include <numeric>

#include "faults/fault.h"
#include "methods/linear.h"
#include "opencl/bands.h"
#include "reference/reference.h"
#include "support.h"

namespace defray::test::linear_psf_test {
namespace {

std::vector<Plane> render(Size size, const std::vector<std::int32_t>& coc,
                          const std::vector<Plane>& channels) {
  return taken(device().linear({size.width, size.height, coc, {}, channels}));
}

std::vector<Plane> planes_of(Size size, std::size_t count) {
  std::vector<Plane> planes;
  for (std::uint32_t c = 0; c < count; ++c) planes.push_back(random_plane(size, c + 5));
  return planes;
}

double sum(const Plane& plane) { return std::accumulate(plane.begin(), plane.end(), 0.0); }

TEST(Linear, KernelEqualsTwinBitForBit) {
  for (const Size size : {Size{1, 1}, {1, 17}, {17, 1}, {13, 7}, {33, 5}, {131, 41}}) {
    for (const double largest : {0.0, 0.3, 1.7, 6.0, 40.0}) {
      if (largest > 6 && (size.width > 33 || is_slow_device())) continue;  // the twin's time
      const auto coc = random_coc(size, largest, 3);
      const auto channels = planes_of(size, 4);
      const auto twin = reference::linear<float>({size.width, size.height, coc, {}, channels});
      EXPECT_EQ(hash_of(render(size, coc, channels)), hash_of(twin))
          << size.width << "x" << size.height << ", CoC " << largest;
    }
  }
}

TEST(Linear, FloatSumsStayWithinTheirBoundOfDouble) {
  const Size size{61, 33};
  const auto coc = random_coc(size, 6, 9);
  const auto channels = planes_of(size, 1);
  const Plane kernel = render(size, coc, channels)[0];
  const auto exact = reference::linear<double>({size.width, size.height, coc, {}, channels})[0];
  // A term carries the roundings of its root, its subtraction (both of numbers up to 14 for a
  // weight from 0 to 1), its quotient and its product; n = 13^2 terms are then added, each
  // addition rounded. u = 2^-24; terms and partial sums are below n L / (disc >= 1) <= n L.
  const double n = 169;
  double largest = 0;
  for (const float c : channels[0]) largest = std::fmax(largest, std::fabs(c));
  const double bound = n * largest * (2 * 14 + 3 + n) * 0x1p-24;
  double worst = 0;
  for (std::size_t i = 0; i < kernel.size(); ++i) {
    worst = std::fmax(worst, std::fabs(kernel[i] - exact[i]));
  }
  EXPECT_LE(worst, bound);
  EXPECT_GT(worst, 0);
}

TEST(Linear, EnergyIsConservedAwayFromTheBorder) {
  const Size size{90, 70};
  for (const double radius : {0.4, 0.5, 1.0, 3.3, 12.0}) {
    Plane light(size.width * size.height), random = random_plane(size, 2);
    for (int y = 13; y < 57; ++y) {
      for (int x = 13; x < 77; ++x) {
        light[y * 90 + x] = std::fabs(random[y * 90 + x]);
      }
    }
    const Plane out = render(size, random_coc(size, radius, 4), {light})[0];
    EXPECT_NEAR(sum(out) / sum(light), 1, 1e-6) << "radius " << radius;
  }
}

TEST(Linear, ImpulsesBecomeDiscsOfTheirRadius) {
  const Size size{101, 101};
  for (const double radius : {0.75, 2.0, 7.3, 20.0, 40.0}) {
    if (radius > 3 && is_slow_device()) continue;
    Plane impulse(101 * 101);
    impulse[50 * 101 + 50] = 1;
    const std::vector<std::int32_t> coc(impulse.size(), std::lround(256 * radius));
    const Plane disc = render(size, coc, {impulse})[0];
    double total = 0, x = 0, y = 0, squares = 0;
    for (int j = 0; j < 101; ++j) {
      for (int i = 0; i < 101; ++i) {
        const double share = disc[j * 101 + i];
        total += share, x += share * (i - 50), y += share * (j - 50);
        squares += share * (std::pow(i - 50, 2) + std::pow(j - 50, 2));
        if (std::hypot(i - 50, j - 50) >= radius + 0.5) {
          EXPECT_EQ(share, 0);
        }
      }
    }
    EXPECT_NEAR(total, 1, 1e-6);
    EXPECT_NEAR(x, 0, 1e-5);
    EXPECT_NEAR(y, 0, 1e-5);
    // The second moment of the soft disc's integral; the pixel grid moves small ones by up to 6 %.
    const double r2 = radius * radius;
    const double moment = 0.5 * (r2 * r2 + r2 / 2 + 1.0 / 80) / (r2 + 1.0 / 12);
    EXPECT_NEAR(squares, moment, 0.06 * moment);
  }
}

TEST(Linear, OneColourStaysThatColour) {
  const Size size{40, 30};
  const std::vector<std::int32_t> coc(1200, 256 * 9);
  const Plane out = render(size, coc, {Plane(1200, 0.7f)})[0];
  for (const float value : out) {
    EXPECT_NEAR(value, 0.7f, 0.7 * 400 * 0x1p-24);  // 19^2 additions
  }
}

TEST(Linear, ClosedApertureReturnsTheInputBitForBit) {
  const Size size{37, 19};
  auto channels = planes_of(size, 3);
  channels[0][5] = -0.0f;
  channels[1][7] = std::numeric_limits<float>::max();
  channels[2][9] = std::numeric_limits<float>::denorm_min();
  EXPECT_EQ(hash_of(render(size, std::vector<std::int32_t>(37 * 19), channels)), hash_of(channels));
}

TEST(Linear, NonfiniteLightStaysInItsDisc) {
  const Size size{41, 41};
  Plane plane(41 * 41, 0.5f);
  plane[20 * 41 + 20] = std::numeric_limits<float>::infinity();
  std::vector<std::int32_t> coc(plane.size(), 256 * 9);
  coc[20 * 41 + 20] = 256 * 3;
  const Plane out = render(size, coc, {plane})[0];
  for (int y = 0; y < 41; ++y) {
    for (int x = 0; x < 41; ++x) {
      EXPECT_EQ(std::isfinite(out[y * 41 + x]), std::hypot(x - 20, y - 20) >= 3.5) << x << "," << y;
    }
  }
}

TEST(Linear, SameBitsForEveryMemoryBudgetAndWorkGroup) {
  const Size size{67, 45};
  const auto coc = random_coc(size, 5, 8);
  const auto channels = planes_of(size, 2);
  const std::uint64_t expected = hash_of(render(size, coc, channels));
  for (const std::size_t kib : {22, 30, 64, 100}) {
    const InBands in_bands(session(), kib << 10);
    EXPECT_EQ(hash_of(render(size, coc, channels)), expected) << kib << " KiB";
  }
  Session s(device_under_test());
  for (const auto& [x, y] : {std::pair<std::size_t, std::size_t>{1, 1}, {7, 3}, {64, 1}}) {
    s.set_work_group(x, y);
    EXPECT_EQ(hash_of(taken(DeviceBackend(s).linear({size.width, size.height, coc, {}, channels}))),
              expected)
        << x << "x" << y;
  }
}

/// In host memory too: what the kernel reads are copies anywhere.
TEST(Linear, SameBitsInBandsOfAnyHeight) {
  for (const Size size : {Size{1, 1}, {1, 37}, {37, 1}, {16, 16}, {33, 45}}) {
    for (const double largest : {0.0, 1.7, is_slow_device() ? 2.0 : 20.0}) {
      const auto coc = random_coc(size, largest, 8);
      for (std::size_t count = 1; count <= 4; ++count) {
        const auto channels = planes_of(size, count);
        const Frame f{size.width, size.height, coc, {}, channels};
        const auto expected = render(size, coc, channels);
        ASSERT_EQ(expected.size(), count);
        for (const int rows : {1, 2, 7, 30}) {
          const InBands in_bands(session(), band_bytes("linear_psf", f, linear_reach(coc), rows));
          for (const bool copies : {true, false}) {
            session().set_copies(copies);
            EXPECT_EQ(hash_of(render(size, coc, channels)), hash_of(expected))
                << size.width << "x" << size.height << ", CoC " << largest << ", " << rows
                << (copies ? " rows, copies" : " rows");
          }
        }
      }
    }
  }
}

TEST(Linear, RefusesWhatItCannotReach) {
  const std::vector<std::int32_t> wide(4, 1025 * 256), some(4, 100 * 256);
  expect_error(ErrorKind::usage, {"1025 px", "1024", "max_coc_px", "rdb"}, [&] {
    render({2, 2}, wide, {Plane(4)});
  });
  const Frame f{2, 2, some, {}, {Plane(4)}};
  // 2 rows of 16 pixels and 100 on each side, of 5 planes; a row of 4.
  const std::size_t least = (2 * (16 + 2 * 100) * 5 + 2 * 4) * 4;
  EXPECT_EQ(band_bytes("linear_psf", f, 100, 1), least);
  const InBands in_bands(session(), least - 1);
  expect_error(ErrorKind::usage, {"memory", "100 px", "MiB"}, [&] {
    render({2, 2}, some, {Plane(4)});
  });
}

const FaultRows faults{
    {"linear_psf",
     "radius a tenth of a pixel too large",
     {"2.0f * clamp(radius + 0.5f", "2.0f * clamp(radius + 0.6f"}},
    {"linear_psf", "chord one pixel short", {"beyond - 1);", "beyond - 2);"}},
    {"linear_psf",
     "row reach one pixel short",
     {"abs(dy) >= (uint)beyond", "abs(dy) >= (uint)beyond - 1u"}},
    {"linear_psf",
     "one column off",
     {"(uint)(target.x + p.reach)", "(uint)(target.x + p.reach + 1)"}},
    {"linear_psf", "band's first row forgotten", {"target.y + (int)p.band_row;", "target.y;"}},
    {"linear_psf",
     "rows beyond the frame dropped",
     {"const int source_row = clamp(y + dy, 0, (int)p.window_rows - 1);",
      "const int source_row = y + dy;\n"
      "    if (source_row < 0 || source_row >= (int)p.window_rows) continue;"}},
    {"linear_psf",
     "0 x Inf reaches what the disc does not",
     {"select((float16)(-0.0f), weight * colour, weight > 0.0f)", "weight * colour"}},
    {"linear_psf", "last source row dropped", {"dy <= p.reach; ++dy", "dy < p.reach; ++dy"}},
};

}  // namespace
}  // namespace defray::test::linear_psf_test
