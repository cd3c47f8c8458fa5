#pragma once
// A frame that the chain goes through in bands of rows, with so much memory and so little.
#include <cmath>

#include "base/random.h"
#include "chain/chain.h"
#include "chain/half_size.h"
#include "support.h"

namespace defray::test {

/// A wall that slants, bars and a beam before it, lamps, a corner of sky, and zeros of both signs.
struct Shot {
  int width, height, channels = 3;
  bool is_antialiased = false;
  double blur_px = 12;  ///< Of background; near things have more.
  int lamp_every = 1500;
  bool has_wires = false;  ///< Thin ones that go on behind beams of 60 rows.

  float depth_at(int x, int y) const {
    if (x > width * 3 / 4 && y < height / 5) return HUGE_VALF;
    if (has_wires) {
      if (y % 128 >= 40 && y % 128 < 100) return 1.2f;
      return (x + y / 4) % 31 < 4 ? 2.6f : 4.0f;
    }
    if (y >= 60 && y < 66) return 2.95f;
    if (x % 47 >= 20 && x % 47 < 26) return 1.2f;
    if (is_antialiased && x % 47 == 19) return 2.2f;
    return 4 + 0.002f * static_cast<float>(y);
  }

  float colour_at(int x, int y, int channel) const {
    if (is_antialiased && depth_at(x, y) == 2.2f) {  // in the shares of its depth
      const float low = colour_at(x - 1, y, channel), z = depth_at(x - 1, y);
      return low + (2.2f - z) / (1.2f - z) * (colour_at(x + 1, y, channel) - low);
    }
    Random random(x, y, static_cast<std::uint32_t>(channel));
    if (channel == 3) return x / 50 % 3 == 0 ? 0 : 1;
    if (Random(x, y, 9).next() * lamp_every < 1) return 500;
    if (y % 90 == 89) return -0.0f;
    return ((x / 7 + y / 5) % 2 ? 0.7f : 0.2f) + 0.1f * static_cast<float>(random.next());
  }

  Frame frame() const {
    std::vector<std::int32_t> coc;
    Plane depth;
    std::vector<Plane> planes(static_cast<std::size_t>(channels));
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const double z = depth.emplace_back(depth_at(x, y));
        const double px = std::isinf(z) ? blur_px : blur_px * (z - 3) / z;
        coc.push_back(static_cast<std::int32_t>(std::lround(256 * px)));
        for (int c = 0; c < channels; ++c) {
          planes[static_cast<std::size_t>(c)].push_back(colour_at(x, y, c));
        }
      }
    }
    Frame f{width, height, coc, depth, planes, channels == 4};
    f.origin_x = 5;
    f.origin_y = -3;
    f.display_width = width + 20;
    f.display_height = height + 4;
    return f;
  }
};

/// Memory of the session's stages until this ends.
class Memory {
 public:
  explicit Memory(std::size_t bytes) { session().set_memory(bytes); }
  ~Memory() { session().set_memory(default_memory_bytes); }
  Memory(const Memory&) = delete;
  Memory& operator=(const Memory&) = delete;
};

inline constexpr std::size_t all_rows = std::size_t{1} << 40, fewest_rows = 1 << 20;

inline MethodResult rendered(const Frame& f, const ChainSettings& s, std::size_t memory,
                             bool nearest) {
  const Memory given(memory);
  return (s.half_size ? run_half_size : run_chain)(f, s, device(), nearest, {});
}

inline void expect_same(const MethodResult& a, const MethodResult& b) {
  ASSERT_EQ(a.colour.size(), b.colour.size());
  EXPECT_EQ(hash_of(a.colour), hash_of(b.colour));
  EXPECT_EQ(hash_of({a.confidence, a.tiles.picture()}), hash_of({b.confidence, b.tiles.picture()}));
  EXPECT_EQ(a.nearest, b.nearest);
  EXPECT_EQ(a.report->repaired, b.report->repaired);
  EXPECT_EQ(a.report->behind, b.report->behind);
  EXPECT_EQ(a.report->split, b.report->split);
  EXPECT_EQ(a.report->highlights, b.report->highlights);
  EXPECT_EQ(a.report->interpolated, b.report->interpolated);
  EXPECT_EQ(a.report->border_px, b.report->border_px);
  EXPECT_EQ(a.report->confidence, b.report->confidence);
}

}  // namespace defray::test
