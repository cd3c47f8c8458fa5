// The search for shifts parallel to the picture, retold in plain loops.
#include <cmath>

#include "patterns_search.h"

namespace defray::test::parallel_search_test {
namespace {

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

std::vector<PatternShift> expected_shifts(const SearchScene& s) {
  std::vector<Length> found;
  add_lengths(s, false, found);
  add_lengths(s, true, found);
  std::stable_sort(found.begin(), found.end(),
                   [](const Length& a, const Length& b) { return a.first < b.first; });
  found.resize(std::min(found.size(), size(s.settings.parallel_shifts)));
  std::vector<PatternShift> expected;
  for (const auto& [cost, shift] : found) {
    const float frame_square = static_cast<float>(static_cast<double>(cost) / 256);
    expected.push_back({shift.x, shift.y, shift.parallel, frame_square});
    expected.push_back({-shift.x, -shift.y, shift.parallel, frame_square});
  }
  return expected;
}

TEST(ParallelSearch, FindsTheParallelShiftsThatPlainLoopsFind) {
  std::size_t count = 0;
  for (int seed = 0; seed < 10; ++seed) {
    const SearchScene s = search_scene(90 + seed, 80 - seed, seed, seed % 2 == 0);
    const auto expected = expected_shifts(s);
    count += expected.size();
    EXPECT_EQ(find_parallel_shifts(s.frame(), s.words(), s.settings), expected) << seed;
  }
  EXPECT_GT(count, 10u);
}

/// Few pairs, of which a single one more would make another length the best.
TEST(ParallelSearch, CountsEveryPairOfSmallFrames) {
  std::size_t count = 0;
  for (int seed = 0; seed < 150; ++seed) {
    SearchScene s = search_scene(34 + seed % 7, 27 + seed % 5, seed, seed % 2 == 0);
    for (std::size_t i = 0; i < s.grid.coc.size(); ++i) s.grid.coc[i] = 0;
    const auto expected = expected_shifts(s);
    count += expected.size();
    EXPECT_EQ(find_parallel_shifts(s.frame(), s.words(), s.settings), expected) << seed;
  }
  EXPECT_GT(count, 150u);
}

}  // namespace
}  // namespace defray::test::parallel_search_test
