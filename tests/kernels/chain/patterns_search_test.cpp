// The search for shifts, retold in plain loops.
#include "patterns_search.h"

#include <map>
#include <tuple>

namespace defray::test::patterns_search_test {
namespace {

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

/// One row of so many holds no more than 65536 in all.
int step_of(const Grid& g) { return static_cast<int>((g.colour.size() + 65535) / 65536); }

/// Of a grid with itself shifted; rows from the first that both have, one of so many.
std::uint64_t cost_of(const Grid& g, int dx, int dy, int row_step, std::uint64_t all,
                      std::uint64_t least, int tolerance) {
  Cost cost;
  for (int y = std::max(0, -dy); y < g.height; y += row_step) {
    for (int x = 0; x < g.width; ++x) {
      if (g.contains(x + dx, y + dy)) cost.add(g, g.at(x, y), g.at(x + dx, y + dy), tolerance);
    }
  }
  return cost.pairs == 0 || cost.pairs < least ? none : cost.of(all);
}

using Candidate = std::tuple<std::uint64_t, int, int>;  ///< Cost, y, x: in the order of places.

std::vector<Candidate> coarse_minima(const SearchScene& s) {
  const Grid blocks = blocks_of(s.grid);
  const int reach_x = s.settings.reach_x_px / 4, reach_y = s.settings.reach_y_px / 4;
  const std::size_t all = blocks.colour.size() / size(step_of(blocks));
  std::map<std::pair<int, int>, std::uint64_t> cost;
  for (int y = 0; y <= reach_y; ++y) {
    for (int x = -reach_x; x <= reach_x; ++x) {
      cost[{x, y}] = cost[{-x, -y}] = cost_of(blocks, x, y, step_of(blocks), all, all / 50, 40);
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
  const int step = std::max(8, step_of(s.grid));
  const std::size_t pixels = s.grid.colour.size() * 8 / size(step);
  for (const auto& [unused, y, x] : found) {
    Candidate best{none, 0, 0};
    for (int dy = y - 3; dy <= y + 3; ++dy) {
      for (int dx = x - 3; dx <= x + 3; ++dx) {
        best = std::min(best, Candidate{cost_of(s.grid, dx, dy, step, pixels, 1, 40), dy, dx});
      }
    }
    refined.push_back(best);
  }
  std::sort(refined.begin(), refined.end());
  refined.erase(std::unique(refined.begin(), refined.end()), refined.end());
  std::vector<PatternShift> shifts;
  for (const auto& [cost, y, x] : refined) {
    const float frame_square = static_cast<float>(static_cast<double>(cost) / 256);
    shifts.push_back({x, y, 0, frame_square});
    shifts.push_back({-x, -y, 0, frame_square});
  }
  return shifts;
}

TEST(PatternSearch, FindsTheShiftsThatPlainLoopsFind) {
  std::size_t count = 0;
  for (int seed = 0; seed < 8; ++seed) {
    const SearchScene s = search_scene(80 + seed, 57 + 2 * seed, seed, seed % 3 == 0);
    const auto expected = expected_shifts(s);
    count += expected.size();
    EXPECT_EQ(find_pattern_shifts(device(), s.frame(), s.words(), s.settings), expected) << seed;
  }
  EXPECT_GT(count, 40u);
}

TEST(PatternSearch, FindsTheSameInBands) {
  const SearchScene s = search_scene(90, 160, 3, false);
  const InBands bands(session(), 90 * 8 * 60);
  EXPECT_EQ(find_pattern_shifts(device(), s.frame(), s.words(), s.settings), expected_shifts(s));
}

/// Nothing but a little noise: every shift agrees almost as well.
SearchScene noise_scene(int width, int height, int seed) {
  SearchScene s = search_scene(width, height, seed, false);
  for (std::size_t i = 0; i < s.grid.colour.size(); ++i) {
    Random random(static_cast<int>(i), 7, static_cast<std::uint32_t>(seed));
    for (int& v : s.grid.colour[i]) v = static_cast<int>(4 * random.next());
  }
  return s;
}

TEST(PatternSearch, OfShiftsThatAgreeAsWellThoseWithMorePartnersAreBetter) {
  for (int seed = 0; seed < 12; ++seed) {
    const SearchScene s = noise_scene(80 + seed, 57 + 2 * seed, seed);
    EXPECT_EQ(find_pattern_shifts(device(), s.frame(), s.words(), s.settings), expected_shifts(s))
        << seed;
  }
}

/// Unless told otherwise shifts go up to 160 px across and 128 down, of fronts within a pixel of
/// CoC.
TEST(PatternSearch, ReachesAsFarAsItIsSaidTo) {
  for (const auto& [x, y, is_found] :
       {std::tuple{160, 0, true}, {168, 0, false}, {0, 128, true}, {0, 136, false}}) {
    SearchScene s = noise_scene(420, 320, 5);
    for (int v = 0; v < 320; ++v) {
      for (int u = 0; u < 420; ++u) {
        Random random(x ? u % x : u, y ? v % y : v, 3);
        s.grid.colour[s.grid.at(u, v)] = {static_cast<int>(255 * random.next()), 0, 0};
        s.grid.coc[s.grid.at(u, v)] = (u + v) % 2 ? 256 : 0;
      }
    }
    const auto shifts = find_pattern_shifts(device(), s.frame(), s.words(), {});
    const bool has = !shifts.empty() && shifts[0].x == x && shifts[0].y == y;
    EXPECT_EQ(has, is_found) << x << " " << y;
    EXPECT_LE(shifts.size(), 2 * 24u);
  }
}

TEST(PatternSearch, LooksAtSomeRowsOfLargeFrames) {
  SearchScene s = noise_scene(1240, 1040, 1);
  s.settings.reach_x_px = 16;
  s.settings.reach_y_px = 12;
  EXPECT_EQ(find_pattern_shifts(device(), s.frame(), s.words(), s.settings), expected_shifts(s));
}

}  // namespace
}  // namespace defray::test::patterns_search_test
