// The search for shifts, retold in plain loops: what `patterns` is given to look at. On small
// random frames with gaps, several surfaces and few colours, so that costs are close to each other.
#include <algorithm>
#include <map>
#include <tuple>

#include "base/random.h"
#include "chain/patterns.h"
#include "support.h"

namespace defray::test {
namespace {

constexpr std::uint64_t none = std::numeric_limits<std::uint64_t>::max();

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
SearchScene search_scene(int width, int height, int seed, bool is_turned) {
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

Grid blocks_of(const Grid& g) {
  Grid out{g.width / 4, g.height / 4, {}, {}, {}};
  for (int y = 0; y < out.height; ++y) {
    for (int x = 0; x < out.width; ++x) {
      std::array<int, 3> sum{};
      int coc = 0, count = 0;
      for (int j = 0; j < 4; ++j) {
        for (int i = 0; i < 4; ++i) {
          const std::size_t at = g.at(4 * x + i, 4 * y + j);
          if (!g.known[at]) continue;
          ++count;
          coc += g.coc[at];
          for (std::size_t c = 0; c < 3; ++c) sum[c] += g.colour[at][c];
        }
      }
      const bool is_known = count >= 8;
      for (int& v : sum) v = is_known ? (v + count / 2) / count : 0;
      out.colour.push_back(sum);
      out.coc.push_back(is_known ? coc / count : 0);
      out.known.push_back(is_known);
    }
  }
  return out;
}

/// Of a grid with itself shifted; rows from the first that both have, one of so many.
std::uint64_t cost_of(const Grid& g, int dx, int dy, int row_step, std::uint64_t least,
                      int tolerance) {
  Cost cost;
  for (int y = std::max(0, -dy); y < g.height; y += row_step) {
    for (int x = 0; x < g.width; ++x) {
      if (g.contains(x + dx, y + dy)) cost.add(g, g.at(x, y), g.at(x + dx, y + dy), tolerance);
    }
  }
  return cost.pairs == 0 || cost.pairs < least ? none : cost.of(g.colour.size());
}

using Candidate = std::tuple<std::uint64_t, int, int>;  ///< Cost, y, x: in the order of places.

std::vector<Candidate> coarse_minima(const SearchScene& s) {
  const Grid blocks = blocks_of(s.grid);
  const int reach_x = s.settings.reach_x_px / 4, reach_y = s.settings.reach_y_px / 4;
  std::map<std::pair<int, int>, std::uint64_t> cost;
  for (int y = 0; y <= reach_y; ++y) {
    for (int x = -reach_x; x <= reach_x; ++x) {
      cost[{x, y}] = cost[{-x, -y}] = cost_of(blocks, x, y, 1, blocks.colour.size() / 50, 40);
    }
  }
  std::vector<Candidate> minima;
  for (const auto& [shift, here] : cost) {
    const auto [x, y] = shift;
    if (here == none || y < 0 || (y == 0 && x < 1) || std::max(std::abs(x), y) < 2) continue;
    bool is_least = true;
    for (const auto& [other, there] : cost) {
      const bool is_beside = std::abs(other.first - x) <= 1 && std::abs(other.second - y) <= 1;
      is_least = is_least && !(is_beside && there < here);
    }
    if (is_least) minima.push_back({here, 4 * y, 4 * x});
  }
  std::sort(minima.begin(), minima.end());
  return minima;
}

std::vector<PatternShift> expected_shifts(const SearchScene& s) {
  std::vector<Candidate> found = coarse_minima(s), refined;
  found.resize(std::min(found.size(), size(s.settings.shifts)));
  for (const auto& [unused, y, x] : found) {
    Candidate best{none, 0, 0};
    for (int dy = y - 3; dy <= y + 3; ++dy) {
      for (int dx = x - 3; dx <= x + 3; ++dx) {
        best = std::min(best, Candidate{cost_of(s.grid, dx, dy, 8, 1, 40), dy, dx});
      }
    }
    refined.push_back(best);
  }
  std::sort(refined.begin(), refined.end());
  refined.erase(std::unique(refined.begin(), refined.end()), refined.end());
  std::vector<PatternShift> shifts;
  for (const auto& [unused, y, x] : refined) {
    shifts.push_back({x, y});
    shifts.push_back({-x, -y});
  }
  return shifts;
}

TEST(PatternSearch, FindsTheShiftsThatPlainLoopsFind) {
  std::size_t count = 0;
  for (int seed = 0; seed < 8; ++seed) {
    const SearchScene s = search_scene(80 + seed, 57 + 2 * seed, seed, seed % 3 == 0);
    const auto expected = expected_shifts(s);
    count += expected.size();
    EXPECT_EQ(find_pattern_shifts(s.frame(), s.words(), s.settings), expected) << seed;
  }
  EXPECT_GT(count, 40u);
}

/// Rows of samples on slanting surfaces: pixels that are known and slant across the shift.
struct Samples {
  std::vector<std::pair<int, int>> places;
  std::uint64_t known = 0;
  float nearest = 0, farthest = HUGE_VALF;
};

Samples samples_of(const SearchScene& s, bool is_down) {
  Samples all;
  const Grid& g = s.grid;
  for (int y = 0; y + !is_down < g.height; y += 4) {
    for (int x = 0; x + is_down < g.width; ++x) {
      if (!g.known[g.at(x, y)]) continue;
      ++all.known;
      const float here = s.inverse[g.at(x, y)], next = s.inverse[g.at(x + is_down, y + !is_down)];
      if (here <= 0 || std::fabs(next - here) * 2500 <= here) continue;
      all.places.push_back({x, y});
      all.nearest = std::max(all.nearest, here);
      all.farthest = std::min(all.farthest, here);
    }
  }
  return all;
}

std::uint64_t parallel_cost(const SearchScene& s, const Samples& samples, bool is_down,
                            float parallel) {
  const int most = is_down ? s.settings.parallel_reach_y_px : s.settings.parallel_reach_x_px;
  Cost cost;
  for (const auto& [x, y] : samples.places) {
    const float px = parallel * s.inverse[s.grid.at(x, y)];
    if (px < 8 || px > static_cast<float>(most)) continue;
    const int length = static_cast<int>(std::rint(px));
    const int tx = x + (is_down ? 0 : length), ty = y + (is_down ? length : 0);
    if (s.grid.contains(tx, ty)) cost.add(s.grid, s.grid.at(x, y), s.grid.at(tx, ty), 40);
  }
  return cost.pairs == 0 || cost.pairs * 50 < samples.known ? none : cost.of(samples.known);
}

using Length = std::pair<std::uint64_t, PatternShift>;

void add_lengths(const SearchScene& s, bool is_down, std::vector<Length>& found) {
  const Samples samples = samples_of(s, is_down);
  const int reach = is_down ? s.settings.parallel_reach_y_px : s.settings.parallel_reach_x_px;
  std::vector<std::pair<std::uint64_t, float>> all;
  for (double px = 8 / double{samples.nearest}; px * samples.farthest <= reach; px *= 1.02) {
    all.push_back({parallel_cost(s, samples, is_down, static_cast<float>(px)), px});
  }
  std::uint64_t worst_before = 0;
  for (std::size_t i = 1; i + 1 < all.size(); ++i) {
    const auto [cost, parallel] = all[i];
    if (cost == none) continue;
    if (cost < all[i - 1].first && cost <= all[i + 1].first && cost < worst_before / 2) {
      std::pair<std::uint64_t, float> best{none, 0};
      for (int k = -8; k <= 8; ++k) {
        const auto near = static_cast<float>(double{parallel} * (1 + k * 0.0025));
        const std::uint64_t there = parallel_cost(s, samples, is_down, near);
        if (there < best.first) best = {there, near};
      }
      found.push_back({best.first, {is_down ? 0 : reach, is_down ? reach : 0, best.second}});
    }
    worst_before = std::max(worst_before, cost);
  }
}

TEST(PatternSearch, FindsTheParallelShiftsThatPlainLoopsFind) {
  std::size_t count = 0;
  for (int seed = 0; seed < 10; ++seed) {
    const SearchScene s = search_scene(90 + seed, 80 - seed, seed, seed % 2 == 0);
    std::vector<Length> found;
    add_lengths(s, false, found);
    add_lengths(s, true, found);
    std::stable_sort(found.begin(), found.end(),
                     [](const Length& a, const Length& b) { return a.first < b.first; });
    found.resize(std::min(found.size(), size(s.settings.parallel_shifts)));
    std::vector<PatternShift> expected;
    for (const auto& [unused, shift] : found) {
      expected.push_back(shift);
      expected.push_back({-shift.x, -shift.y, shift.parallel});
    }
    count += expected.size();
    EXPECT_EQ(find_parallel_shifts(s.frame(), s.words(), s.settings), expected) << seed;
  }
  EXPECT_GT(count, 10u);
}

}  // namespace
}  // namespace defray::test
