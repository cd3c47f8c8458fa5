// Kernels gather_literal, gather_aware, gather_tiles and gather_reach against their twins, and what
// each kind must and must not do.

#include <cmath>
#include <limits>
#include <set>

#include "kernels/methods/gather_support.h"
#include "opencl/bands.h"
#include "reference/reference.h"

namespace defray::test::gather_test {
namespace {

TEST(Gather, KernelsEqualTwinsBitForBit) {
  const Size frames[] = {{1, 1}, {1, 17}, {17, 1}, {13, 7}, {257, 89}, {5, 300}};
  for (const Size size : frames) {
    if (is_slow_device() && size.width > 100) continue;
    for (const double largest : {0.0, 0.3, 1.7, 8.0, 32.0, 4194303.0}) {
      const auto coc = random_coc(size, largest, 3);
      const auto channels = planes_of(size);
      for (const GatherKind kind : kinds) {
        for (const GatherSettings& s :
             {settings_of(kind, 1, 1, false), settings_of(kind, 7, 2, true),
              settings_of(kind, 32, 3, false)}) {
          const auto twin = taken(twins().gather({size.width, size.height, coc, {}, channels}, s));
          EXPECT_EQ(hash_of(render(size, coc, channels, s)), hash_of(twin))
              << size.width << "x" << size.height << ", CoC " << largest << ", " << s.samples
              << " samples, " << (kind == GatherKind::aware ? "aware" : "literal");
        }
      }
    }
  }
}

TEST(Gather, KernelsEqualTwinsWhereDiscsBeginToCoverMoreThanAPixel) {
  const Size size{24, 16};
  for (int quanta = 100; quanta <= 200; quanta += 4) {
    const std::vector<std::int32_t> coc(24 * 16, quanta);
    const auto channels = planes_of(size);
    const GatherSettings s = settings_of(GatherKind::aware, 200, 1, true);  // some at the rim
    const auto twin = taken(twins().gather({size.width, size.height, coc, {}, channels}, s));
    EXPECT_EQ(hash_of(render(size, coc, channels, s)), hash_of(twin)) << quanta;
  }
}

TEST(Gather, EveryPassTurnsItsSamplesOtherwise) {
  const GatherSettings s = settings_of(GatherKind::literal, 16, 3, true);
  std::set<std::uint32_t> seeds;
  for (int pass = 0; pass < s.passes; ++pass) seeds.insert(gather_params(s, 8, pass).seed);
  EXPECT_EQ(seeds.size(), 3u);
}

/// Variances add up: two literal passes blur like one of a radius sqrt(2) times as large, and the
/// aware ones share one radius.
TEST(Gather, PassesBlurAsMuchAsTheySay) {
  const int side = 65, middle = side / 2;
  const auto variance_of = [&](GatherKind kind, int passes) {
    std::vector<Plane> channels = {Plane(65 * 65)};
    channels[0][static_cast<std::size_t>(middle * side + middle)] = 1;
    const std::vector<std::int32_t> coc(65 * 65, 8 * 256);
    const auto out = render({side, side}, coc, channels, settings_of(kind, 64, passes, true));
    double light = 0, squares = 0;
    for (int y = 0; y < side; ++y) {
      for (int x = 0; x < side; ++x) {
        const double v = out[0][static_cast<std::size_t>(y * side + x)];
        light += v;
        squares += v * (std::pow(x - middle, 2) + std::pow(y - middle, 2));
      }
    }
    return squares / light;
  };
  for (const GatherKind kind : kinds) {
    const double one = variance_of(kind, 1);
    EXPECT_NEAR(one / 32, 1, 0.1);  // r^2 / 2
    EXPECT_NEAR(variance_of(kind, 2) / one, kind == GatherKind::literal ? 2 : 1, 0.1);
  }
}

TEST(Gather, ReachEqualsItsTwin) {
  for (const Size size : {Size{1, 1}, {16, 16}, {17, 16}, {200, 131}}) {
    for (const double largest : {0.0, 3.0, 40.0, 1000.0}) {
      auto coc = random_coc(size, 1, 3);
      coc[coc.size() / 3] = static_cast<std::int32_t>(-256 * largest);
      EXPECT_EQ(device().gather_reach({size.width, size.height, coc}),
                reference::gather_reach({size.width, size.height, coc}))
          << size.width << "x" << size.height << ", CoC " << largest;
    }
  }
}

TEST(Gather, OneColourAndClosedApertureStayBitForBit) {
  const Size size{45, 31};
  const std::vector<Plane> uniform(4, Plane(45 * 31, 0.1f)), varied = planes_of(size);
  const std::vector<std::int32_t> closed(45 * 31);
  for (const GatherKind kind : kinds) {
    const GatherSettings s = settings_of(kind, 32, 2, true);
    EXPECT_EQ(hash_of(render(size, random_coc(size, 9, 2), uniform, s)), hash_of(uniform));
    EXPECT_EQ(hash_of(render(size, closed, varied, s)), hash_of(varied));
  }
}

TEST(Gather, EverySettingChangesThePicture) {
  const Size size{24, 16};
  const auto coc = random_coc(size, 9, 2);
  const auto channels = planes_of(size);
  for (const GatherKind kind : kinds) {
    const GatherSettings plain = settings_of(kind, 32, 2, false);
    const std::uint64_t hash = hash_of(render(size, coc, channels, plain));
    EXPECT_NE(hash, hash_of(render(size, coc, channels, settings_of(kind, 33, 2, false))));
    EXPECT_NE(hash, hash_of(render(size, coc, channels, settings_of(kind, 32, 1, false))));
    EXPECT_NE(hash, hash_of(render(size, coc, channels, settings_of(kind, 32, 2, true))));
    GatherSettings seeded = plain;
    seeded.seed = 1;
    EXPECT_NE(hash, hash_of(render(size, coc, channels, seeded)));
  }
}

TEST(Gather, SameBitsForEveryWorkGroupAndRun) {
  const Size size{is_slow_device() ? 11 : 150, 140};  // more rows than one launch
  const auto coc = random_coc(size, 9, 2);
  const auto channels = planes_of(size);
  Session s(device_under_test());
  for (const GatherKind kind : kinds) {
    const GatherSettings settings = settings_of(kind, is_slow_device() ? 4 : 32, 2, true);
    const std::uint64_t expected = hash_of(render(size, coc, channels, settings));
    for (const auto& [x, y] : {std::pair<std::size_t, std::size_t>{1, 1}, {7, 3}, {64, 4}}) {
      s.set_work_group(x, y);
      EXPECT_EQ(hash_of_planes(DeviceBackend(s).gather({size.width, size.height, coc, {}, channels},
                                                       settings)),
                expected)
          << x << "x" << y;
    }
  }
}

/// A black frame with a white half: `left` and `right` CoC in px.
struct Halves {
  std::vector<std::int32_t> coc;
  Plane colour;
};
Halves halves(double left, double right) {
  Halves h;
  for (int i = 0; i < 64 * 32; ++i) {
    const bool is_left = i % 64 < 32;
    h.coc.push_back(static_cast<std::int32_t>(256 * (is_left ? left : right)));
    h.colour.push_back(is_left ? 0 : 1);
  }
  return h;
}

float left_of_edge(const Halves& h, GatherKind kind) {
  return render({64, 32}, h.coc, {h.colour}, settings_of(kind, 128, 1, false))[0][16 * 64 + 28];
}
float right_of_edge(const Halves& h, GatherKind kind) {
  return render({64, 32}, h.coc, {h.colour}, settings_of(kind, 128, 1, false))[0][16 * 64 + 35];
}

TEST(Gather, OnlyAwareKeepsSharpSurfacesCleanAndLetsNearOnesSpread) {
  // A blurred background must not enter a sharp surface, nor take up its colour.
  const Halves behind = halves(0, 12);
  EXPECT_EQ(left_of_edge(behind, GatherKind::aware), 0);
  EXPECT_EQ(right_of_edge(behind, GatherKind::aware), 1);
  EXPECT_LT(right_of_edge(behind, GatherKind::literal), 0.9);  // the paper's bleeding
  // A blurred foreground spreads over a sharp background; the paper's keeps a hard edge.
  const Halves before = halves(0, -12);
  EXPECT_GT(left_of_edge(before, GatherKind::aware), 0.2);
  EXPECT_EQ(left_of_edge(before, GatherKind::literal), 0);
}

TEST(Gather, MoreSamplesDoNotPileUpBesideNearEdges) {
  // A white near half before a sharp black one: brightness must fall steadily across the edge, also
  // with more samples than the disc has pixels.
  Halves h = halves(-3, 0);
  for (float& value : h.colour) value = 1 - value;
  for (const int samples : {64, 1024}) {
    if (samples > 64 && is_slow_device()) continue;
    const Plane out =
        render({64, 32}, h.coc, {h.colour}, settings_of(GatherKind::aware, samples, 1, false))[0];
    for (int x = 26; x < 40; ++x) {
      EXPECT_LE(out[16 * 64 + x + 1], out[16 * 64 + x] + 0.05)
          << samples << " samples, column " << x;
    }
    // Two pixels beyond the edge a segment of the disc is all that arrives: 20 to 30 %.
    EXPECT_NEAR(out[16 * 64 + 33], 0.2, 0.1) << samples;
  }
}

TEST(Gather, RefusesAbsurdCounts) {
  for (const int samples : {0, -1, 1025}) {
    expect_error(ErrorKind::usage, {"samples", std::to_string(samples), "1 to 1024"},
                 [&] { validate(settings_of(GatherKind::aware, samples, 1, false)); });
  }
  for (const int passes : {0, 9}) {
    expect_error(ErrorKind::usage, {"passes", "1 to 8"},
                 [&] { validate(settings_of(GatherKind::aware, 1, passes, false)); });
    for (Backend* on : device_and_twins()) {
      const Frame frame{1, 1, {0}, {}, {Plane{1}}};
      expect_error(ErrorKind::usage, {"passes"},
                   [&] { on->gather(frame, settings_of(GatherKind::aware, 1, passes, false)); });
    }
  }
}

}  // namespace
}  // namespace defray::test::gather_test
