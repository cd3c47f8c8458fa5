#include "validation/grid.h"

#include <array>
#include <cmath>

#include "base/random.h"

namespace defray::validation {
namespace {

using Sizes = std::vector<std::array<int, 2>>;

Sizes sizes(Level level) {
  if (level == Level::tiny) return {{1, 1}, {1, 17}, {17, 1}, {13, 7}, {37, 11}};
  Sizes all{{1, 1}, {1, 17}, {17, 1}, {13, 7}, {64, 48}, {31, 140}, {257, 89}};
  if (level == Level::full) {
    for (const auto& more : Sizes{{2, 2}, {16, 16}, {33, 17}, {255, 3}, {3, 255}, {640, 480}}) {
      all.push_back(more);
    }
  }
  return all;
}

/// Twin operations that a case may cost: a few hundredths of a second, a second.
double most_work(Level level) {
  switch (level) {
    case Level::tiny:
      return 1e6;
    case Level::quick:
      return 1e7;
    case Level::full:
      return 1e8;
  }
  return 0;
}

/// Every choice comes up early and often: the cases go through them at strides of their own.
template <typename T, std::size_t n>
T pick(const std::array<T, n>& choices, Random& random) {
  return choices[static_cast<std::size_t>(random.next() * n)];
}

Case vary(Case c, Random& random, Level level, std::size_t max_work_group) {
  constexpr std::array patterns{Pattern::constant,   Pattern::slanted, Pattern::steps,
                                Pattern::random,     Pattern::ties,    Pattern::ties,
                                Pattern::converging, Pattern::checker, Pattern::sparse};
  constexpr std::array colours{Colours::plain, Colours::wild, Colours::wild, Colours::extreme,
                               Colours::nonfinite};
  constexpr std::array<std::array<int, 2>, 6> groups{
      {{0, 0}, {0, 0}, {1, 1}, {7, 3}, {64, 1}, {32, 2}}};
  c.pattern = pick(patterns, random);
  c.colours = pick(colours, random);
  c.channels = pick(std::array{1, 2, 3, 4, 4}, random);
  c.cells = pick(std::array{1, 2, 3, 4, 5, 9}, random);
  c.samples = pick(std::array{1, 2, 7, 32}, random);
  c.jitter = random.next() < 0.4;
  c.band_rows = pick(std::array{0, 0, 1, 2, 5, 46}, random);
  c.focus = pick(std::array{3.0, 0.0501, 1.0 / 3, 1e4, HUGE_VAL}, random);
  const auto any_group = pick(groups, random);
  // Each size is another program to compile: a tiny grid has two, and the kernels' own.
  const bool is_common = any_group[0] * any_group[1] <= 21;
  const auto group = level == Level::tiny && !is_common ? groups[3] : any_group;
  if (static_cast<std::size_t>(group[0] * group[1]) <= max_work_group) {
    c.group_x = group[0];
    c.group_y = group[1];
  }
  if (c.pattern == Pattern::converging) {
    c.cells = 2;
    c.jitter = false;
    c.group_x = c.group_y = 1;  // neighbours go to different threads, and meet
  }
  return c;
}

}  // namespace

std::vector<Case> grid(Level level, const KernelCheck& check, std::size_t max_work_group) {
  constexpr std::array cocs{0.0, 0.3, 1.7, 8.0, 32.0, 1000.0, 4194303.0};
  const int repetitions = level == Level::full ? 12 : level == Level::quick ? 2 : 1;
  std::vector<Case> cases;
  std::uint32_t seed = 0;
  for (const auto& [width, height] : sizes(level)) {
    for (const double coc_px : cocs) {
      for (int repetition = 0; repetition < repetitions; ++repetition) {
        Case c;
        c.width = width;
        c.height = height;
        c.coc_px = coc_px;
        c.seed = ++seed;
        Random random(0, 0, seed);
        c = vary(c, random, level, max_work_group);
        if (check.work(c) <= most_work(level)) cases.push_back(c);
      }
    }
  }
  return cases;
}

}  // namespace defray::validation
