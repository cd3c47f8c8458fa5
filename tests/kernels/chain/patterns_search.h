#pragma once
// For the searches for shifts, retold in plain loops: small random frames with gaps, several
// surfaces and few colours, so that costs are close to each other.
#include <algorithm>

#include "base/random.h"
#include "chain/patterns/patterns.h"
#include "support.h"

namespace defray::test {

inline constexpr std::uint64_t none = std::numeric_limits<std::uint64_t>::max();

/// Pixels or blocks: three colours, a CoC, and whether they may be matched.
struct Grid {
  int width, height;
  std::vector<std::array<int, 3>> colour;
  std::vector<int> coc;
  std::vector<bool> known;

  std::size_t at(int x, int y) const { return size(y) * size(width) + size(x); }
  bool contains(int x, int y) const { return x >= 0 && y >= 0 && x < width && y < height; }
  int distance(std::size_t i, std::size_t j) const {
    int sum = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      sum += (colour[i][c] - colour[j][c]) * (colour[i][c] - colour[j][c]);
    }
    return sum;
  }
};

/// Mean squared difference of pairs in 1/256, and what 8 bits hide of it (2/3) over the share that
/// has a partner.
struct Cost {
  std::uint64_t squares = 0, pairs = 0;
  void add(const Grid& g, std::size_t i, std::size_t j, int tolerance) {
    if (!g.known[i] || !g.known[j] || std::abs(g.coc[i] - g.coc[j]) > tolerance) return;
    squares += static_cast<std::uint64_t>(g.distance(i, j));
    ++pairs;
  }
  std::uint64_t of(std::uint64_t all) const { return 256 * squares / pairs + 170 * all / pairs; }
};

struct SearchScene {
  Grid grid;
  Plane inverse;
  PatternSettings settings;

  Words words() const {
    std::vector<std::uint32_t> words;
    for (std::size_t i = 0; i < grid.colour.size(); ++i) {
      const auto& c = grid.colour[i];
      words.push_back(word(c[0]) | word(c[1]) << 8 | word(c[2]) << 16 |
                      (grid.known[i] ? DEFRAY_PATTERN_KNOWN : 0u));
    }
    return words;
  }
  Frame frame() const {
    Frame f{grid.width, grid.height, std::vector<std::int32_t>(grid.coc.begin(), grid.coc.end())};
    f.inverse = inverse;
    return f;
  }
};

/// A pattern of `period` px that noise disturbs, on a floor that slants; `across` may be turned.
inline SearchScene search_scene(int width, int height, int seed, bool is_turned) {
  SearchScene s{{width, height, {}, {}, {}}, {}, {}};
  s.settings.shifts = 3 + seed % 4;
  s.settings.reach_x_px = 30;
  s.settings.reach_y_px = 22;
  s.settings.parallel_shifts = 1 + seed % 3;
  s.settings.parallel_reach_x_px = 60;
  s.settings.parallel_reach_y_px = 40;
  s.settings.tolerance_quanta = 40;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      Random random(x, y, static_cast<std::uint32_t>(seed));
      const int along = is_turned ? y : x, row = is_turned ? x : y;
      const float slant = static_cast<float>(0.5 + 0.03 * row);
      const bool is_flat = row < 6, is_nothing = random.next() < 0.05;
      s.inverse.push_back(is_nothing ? 0.0f : is_flat ? 0.5f : slant);
      const int tile = static_cast<int>(along / (10.0 * slant)) + row / 5;
      std::array<int, 3> colour{};
      for (std::size_t c = 0; c < 3; ++c) {
        colour[c] =
            60 * (tile * (static_cast<int>(c) + 2) % 3) + static_cast<int>(90 * random.next());
      }
      s.grid.colour.push_back(colour);
      s.grid.coc.push_back(x > width / 2 && seed % 2 ? 300 : static_cast<int>(80 * random.next()));
      s.grid.known.push_back(random.next() < 0.8 && !(x > 30 && x < 37));
    }
  }
  return s;
}

}  // namespace defray::test
