// Colours at their limits through every method: kernel and twin alike, and light that is no number
// stays within reach of its pixel.
#include <bit>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <random>

#include "lens/lens_grid.h"
#include "methods/method.h"
#include "numbers.h"
#include "reference/reference.h"
#include "support.h"

namespace defray::test::extreme_colours_test {
namespace {

/// A method, and the farthest that one pixel's colour gets to another's: the radius px from their
/// own CoC radii.
struct Case {
  std::string name;
  MethodSettings settings;
  std::function<double(double target, double source)> reach;
};

std::vector<Case> cases() {
  std::vector<Case> all(4);
  all[0].name = "rdb";
  all[0].reach = [](double, double source) { return source + std::sqrt(0.5); };
  all[1].name = "linear";
  all[1].settings.method = Method::linear;
  all[1].reach = [](double, double source) { return source + 0.5; };
  all[2].name = "literal gather";
  all[2].settings.gather.kind = GatherKind::literal;
  // Bilinear reads take in the pixel beyond, in x and in y.
  all[2].reach = [](double target, double) { return target + std::sqrt(2); };
  all[3].name = "aware gather";
  all[3].reach = [](double target, double source) { return std::fmax(target, source) + 0.5; };
  for (Case& c : all) {
    if (c.name.ends_with("gather")) c.settings.method = Method::gather;
    c.settings.rdb.cells_per_side = is_slow_device() ? 3 : 7;
    c.settings.gather.passes = 1;
    c.settings.gather.samples = is_slow_device() ? 8 : 32;
  }
  return all;
}

Size frame_size() { return is_slow_device() ? Size{19, 13} : Size{61, 43}; }

/// What a device may lose that takes denormals for 0, in a sum of so many terms.
double lost(double terms) { return session().info().keeps_denormals ? 0 : terms * smallest; }

bool is_same(float a, float b, double tolerance) {
  if (std::isnan(a) || std::isnan(b)) return std::isnan(a) && std::isnan(b);
  std::uint32_t bits_a, bits_b;
  std::memcpy(&bits_a, &a, sizeof(a));
  std::memcpy(&bits_b, &b, sizeof(b));
  return bits_a == bits_b || std::fabs(double(a) - double(b)) < tolerance;
}

/// Expects the same bits, but for NaN's own and what a device takes for 0.
void expect_same(const std::vector<Plane>& a, const std::vector<Plane>& b) {
  const double tolerance = lost(4096);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t c = 0; c < a.size(); ++c) {
    for (std::size_t i = 0; i < a[c].size(); ++i) {
      ASSERT_TRUE(is_same(a[c][i], b[c][i], tolerance))
          << a[c][i] << " and " << b[c][i] << " at pixel " << i << " of channel " << c;
    }
  }
}

/// Bits of a number; of what is none, that it is none: its other bits no device has to keep.
std::uint32_t bits_of(float value) {
  return std::isnan(value) ? 0x7fc00000u : std::bit_cast<std::uint32_t>(value);
}

Plane drawn_from(Size size, const std::vector<float>& values, std::uint32_t seed) {
  std::mt19937 random(seed);
  Plane plane(static_cast<std::size_t>(size.width * size.height));
  for (float& v : plane) v = values[random() % values.size()];
  return plane;
}

/// Nothing, hardly anything, half float's end, and the ends of float.
std::vector<Plane> extreme_colours(Size size) {
  return {drawn_from(size, {0, -0.0f, denormal, -denormal, 1000 * denormal, smallest}, 1),
          drawn_from(size, {65504, -65504, 6.1e-5f, 6e-8f, 1, -1}, 2),
          drawn_from(size, {1e30f, -1e30f, 1e-30f, 0, -0.0f, 1e30f}, 3),
          drawn_from(size, {largest, -largest, 0, 1, largest, denormal}, 4)};
}

TEST(ExtremeColours, KernelsEqualTwins) {
  const Size size = frame_size();
  const Plane depth = random_depth(size, 5);
  const std::vector<Plane> colour = extreme_colours(size);
  for (const double radius : {0.4, 1.7, 6.0}) {
    const auto coc = random_coc(size, is_slow_device() ? radius / 3 : radius, 6);
    for (const Case& c : cases()) {
      SCOPED_TRACE(c.name + ", CoC up to " + std::to_string(radius));
      const Frame frame{size.width, size.height, coc, depth, colour};
      expect_same(apply_method(frame, c.settings, device()).colour,
                  apply_method(frame, c.settings, twins()).colour);
    }
  }
}

TEST(ExtremeColours, ClosedApertureKeepsEveryBit) {
  const Size size = frame_size();
  const Plane depth = random_depth(size, 5);
  auto colour = extreme_colours(size);
  colour[1] = drawn_from(size, {infinite, -infinite, nan, 2}, 7);
  const std::vector<std::int32_t> coc(depth.size());
  for (const Case& c : cases()) {
    const Frame frame{size.width, size.height, coc, depth, colour};
    for (Backend* s : device_and_twins()) {
      const std::vector<Plane> out = apply_method(frame, c.settings, *s).colour;
      ASSERT_EQ(out.size(), colour.size());
      for (std::size_t i = 0; i < colour.size() * depth.size(); ++i) {
        const std::size_t channel = i % colour.size(), pixel = i / colour.size();
        const float value = out[channel][pixel], expected = colour[channel][pixel];
        ASSERT_EQ(bits_of(value), bits_of(expected)) << c.name << ": " << value << ", " << expected;
      }
    }
  }
}

TEST(ExtremeColours, UpToTenToThe30EverySumIsFinite) {
  // L the largest colour: the RDB adds up 4096 differences of 2 L at most, the gather 1024 with
  // weights of a few, linear 2049^2 shares of L: all below 2^23 L, and floats go to 3.4e38.
  const Size size = frame_size();
  const Plane depth = random_depth(size, 5);
  const auto coc = random_coc(size, is_slow_device() ? 2 : 9, 6);
  const std::vector<Plane> colour{drawn_from(size, {1e30f, -1e30f, 1e30f, 0}, 3),
                                  drawn_from(size, {65504, -65504, 1e30f, 1e-30f}, 4)};
  for (const Case& c : cases()) {
    const Frame frame{size.width, size.height, coc, depth, colour};
    for (const Plane& plane : apply_method(frame, c.settings, device()).colour) {
      for (const float v : plane) ASSERT_TRUE(std::isfinite(v)) << c.name;
    }
  }
}

/// A dozen pixels that are no number.
std::vector<std::size_t> poison(Plane& plane) {
  std::vector<std::size_t> where;
  for (std::size_t i = 0; i < 12; ++i) {
    where.push_back((i * plane.size() + 5) / 12);
    plane[where.back()] = i % 3 == 0 ? nan : i % 3 == 1 ? infinite : -infinite;
  }
  return where;
}

TEST(ExtremeColours, WhatIsNoNumberStaysWithinReach) {
  const Size size = frame_size();
  const Plane depth = random_depth(size, 5);
  const auto coc = random_coc(size, 3, 8);
  const Plane clean = random_plane(size, 9);
  Plane poisoned = clean;
  const auto where = poison(poisoned);
  const auto radius = [&](std::size_t i) { return std::abs(coc[i]) / 256.0; };
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.name);
    const Frame frame{size.width, size.height, coc, depth, {clean}};
    const Frame bad{size.width, size.height, coc, depth, {poisoned}};
    const Plane expected = apply_method(frame, c.settings, device()).colour[0];
    const std::vector<Plane> out = apply_method(bad, c.settings, device()).colour;
    expect_same(out, apply_method(bad, c.settings, twins()).colour);
    std::size_t spread = 0, untouched = 0;
    const int width = size.width;
    for (std::size_t i = 0; i < clean.size(); ++i) {
      const bool is_reached = std::any_of(where.begin(), where.end(), [&](std::size_t p) {
        const int dx = int(i) % width - int(p) % width, dy = int(i) / width - int(p) / width;
        return std::hypot(dx, dy) <= c.reach(radius(i), radius(p)) || i == p;
      });
      spread += !std::isfinite(out[0][i]);
      untouched += !is_reached;
      if (!is_reached) {
        ASSERT_EQ(out[0][i], expected[i]) << "pixel " << i;
      }
    }
    EXPECT_GT(spread, where.size());
    EXPECT_GT(untouched, clean.size() / 4);
  }
}

}  // namespace
}  // namespace defray::test::extreme_colours_test
