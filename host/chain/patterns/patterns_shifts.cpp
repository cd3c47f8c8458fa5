// The shifts at which a picture resembles itself: coarse search on block means, refined on pixels.
// Integers throughout: the same shifts on every machine, whatever the number of threads.
#include <algorithm>
#include <cstdlib>
#include <limits>
#include <memory>
#include <tuple>

#include "base/parallel.h"
#include "base/vectorised.h"
#include "chain/patterns/patterns.h"

namespace defray {
namespace {

constexpr int block = 4;                      ///< Side of the blocks of the coarse search, px.
constexpr int refine_px = 3;                  ///< Around a coarse minimum.
constexpr int refine_rows = 8;                ///< One row of so many is compared, or of more:
constexpr std::size_t most_blocks = 1 << 16;  ///< In all, of the coarse search,
constexpr std::size_t most_pixels = 1 << 16;  ///< and of the refining one.
constexpr std::uint64_t no_shift_cost = std::numeric_limits<std::uint64_t>::max();

/// Colours and CoC as the comparison reads them; `known` is 0 or -1, all bits.
struct SearchedPicture {
  /// Its values are still to be written.
  SearchedPicture(int w, int h) : width(w), height(h) {
    for (auto* const channel : {&r, &g, &b, &known}) {
      *channel = std::make_unique_for_overwrite<std::int16_t[]>(pixels());
    }
    coc = std::make_unique_for_overwrite<std::int32_t[]>(pixels());
  }
  std::size_t pixels() const { return size(width) * size(height); }

  int width, height;
  std::unique_ptr<std::int16_t[]> r, g, b, known;
  std::unique_ptr<std::int32_t[]> coc;
};

SearchedPicture whole_picture(const Frame& frame, const Words& pixels) {
  SearchedPicture p(frame.width, frame.height);
  const auto words = pixels.host();
  const auto coc = frame.coc_quanta.host();
  parallel_for_each(words.size(), [&](std::size_t i) {
    const std::uint32_t v = words[i];
    p.r[i] = static_cast<std::int16_t>(v & 255);
    p.g[i] = static_cast<std::int16_t>(v >> 8 & 255);
    p.b[i] = static_cast<std::int16_t>(v >> 16 & 255);
    p.known[i] = v & DEFRAY_PATTERN_KNOWN ? -1 : 0;
    p.coc[i] = coc[i];
  });
  return p;
}

/// Means over the known pixels of blocks; known are those that are at least half known.
SearchedPicture block_means(const SearchedPicture& p) {
  SearchedPicture means(p.width / block, p.height / block);
  parallel_for_each(means.pixels(), [&](std::size_t i) {
    const int x = static_cast<int>(i % size(means.width)) * block;
    const int y = static_cast<int>(i / size(means.width)) * block;
    std::int64_t count = 0, r = 0, g = 0, b = 0, coc = 0;
    for (int k = 0; k < block * block; ++k) {
      const std::size_t at = size(y + k / block) * size(p.width) + size(x + k % block);
      if (!p.known[at]) continue;
      ++count;
      r += p.r[at];
      g += p.g[at];
      b += p.b[at];
      coc += p.coc[at];
    }
    means.known[i] = 2 * count < block * block ? 0 : -1;
    count = std::max<std::int64_t>(count, 1);
    means.r[i] = static_cast<std::int16_t>((r + count / 2) / count);
    means.g[i] = static_cast<std::int16_t>((g + count / 2) / count);
    means.b[i] = static_cast<std::int16_t>((b + count / 2) / count);
    means.coc[i] = static_cast<std::int32_t>(coc / count);
  });
  return means;
}

struct Agreement {
  std::uint64_t squares = 0, pairs = 0;

  /// The mean squared difference in 1/256, and what rounding to 8 bits hides of it (2/3) over the
  /// share of `all` pixels that have a partner: of shifts that agree as well as can be seen, the
  /// one that more pixels can use is the better. `no_shift_cost` with fewer pairs than `least`.
  std::uint64_t cost(std::size_t all, std::size_t least) const {
    constexpr std::uint64_t hidden = 2 * 256 / 3;
    return pairs == 0 || pairs < least ? no_shift_cost
                                       : (squares << 8) / pairs + hidden * all / pairs;
  }
};

/// Adds `count` pairs that begin at these indices.
DEFRAY_VECTORISED void add_pairs(const SearchedPicture& p, std::size_t at, std::size_t there,
                                 int count, std::int32_t tolerance, Agreement& sum) {
  // Below 2^32 in a run: 3 x 255^2 x 16384.
  constexpr int run = 16384;
  for (int first = 0; first < count; first += run) {
    const std::size_t end = size(std::min(run, count - first));
    const std::size_t i = at + size(first), j = there + size(first);
    std::uint32_t squares = 0, pairs = 0;
    for (std::size_t k = 0; k < end; ++k) {
      // Radii go up to 2^30: their difference fits 32 bits without a sign.
      const auto a = static_cast<std::uint32_t>(p.coc[i + k]);
      const auto b = static_cast<std::uint32_t>(p.coc[j + k]);
      const bool is_close = a - b + static_cast<std::uint32_t>(tolerance) <=
                            2 * static_cast<std::uint32_t>(tolerance);
      const int mask = p.known[i + k] & p.known[j + k] & -static_cast<int>(is_close);
      const int r = (p.r[i + k] - p.r[j + k]) & mask;
      const int g = (p.g[i + k] - p.g[j + k]) & mask;
      const int b2 = (p.b[i + k] - p.b[j + k]) & mask;
      squares += static_cast<std::uint32_t>(r * r + g * g + b2 * b2);
      pairs += static_cast<std::uint32_t>(mask & 1);
    }
    sum.squares += squares;
    sum.pairs += pairs;
  }
}

/// How well a picture agrees with itself shifted, over one row of `row_step`.
Agreement agreement(const SearchedPicture& p, PatternShift s, int row_step,
                    std::int32_t tolerance) {
  Agreement sum;
  const int x = std::max(0, -s.x), count = p.width - std::abs(s.x);
  if (count <= 0) return sum;
  for (int y = std::max(0, -s.y); y < p.height - std::max(0, s.y); y += row_step) {
    add_pairs(p, size(y) * size(p.width) + size(x), size(y + s.y) * size(p.width) + size(x + s.x),
              count, tolerance, sum);
  }
  return sum;
}

/// One row of how many holds no more than `most` in all.
int row_step(const SearchedPicture& p, std::size_t most) {
  return std::max(1, static_cast<int>((p.pixels() + most - 1) / most));
}

struct Candidate {
  std::uint64_t cost;
  PatternShift shift;
};

/// One order for all machines: the best first, equal ones by place.
void sort_candidates(std::vector<Candidate>& all) {
  std::sort(all.begin(), all.end(), [](const Candidate& a, const Candidate& b) {
    return std::tie(a.cost, a.shift.y, a.shift.x) < std::tie(b.cost, b.shift.y, b.shift.x);
  });
}

/// Costs of shifts of whole blocks: y from 0, the other half plane being the same.
class CoarseMap {
 public:
  CoarseMap(const SearchedPicture& blocks, const PatternSettings& s)
      : reach_x_(s.reach_x_px / block),
        reach_y_(s.reach_y_px / block),
        costs_(size((2 * reach_x_ + 1) * (reach_y_ + 1))) {
    constexpr std::size_t least_share = 50;  // a fiftieth
    const int step = row_step(blocks, most_blocks);
    const std::size_t all = blocks.pixels() / size(step);
    parallel_for(reach_y_ + 1, [&](int y) {
      for (int x = -reach_x_; x <= reach_x_; ++x) {
        costs_[index(x, y)] =
            agreement(blocks, {x, y}, step, s.tolerance_quanta).cost(all, all / least_share);
      }
    });
  }

  /// In pixels. On a plateau every shift counts.
  std::vector<Candidate> minima() const {
    std::vector<Candidate> all;
    for (int y = 0; y <= reach_y_; ++y) {
      for (int x = y == 0 ? 1 : -reach_x_; x <= reach_x_; ++x) {
        const bool is_far = std::max(std::abs(x), y) * block >= DEFRAY_PATTERN_LEAST;
        if (is_far && is_minimum(x, y)) all.push_back({at(x, y), {x * block, y * block}});
      }
    }
    return all;
  }

 private:
  std::size_t index(int x, int y) const { return size(y * (2 * reach_x_ + 1) + x + reach_x_); }

  std::uint64_t at(int x, int y) const {
    if (y < 0) return at(-x, -y);
    return std::abs(x) > reach_x_ || y > reach_y_ ? no_shift_cost : costs_[index(x, y)];
  }

  bool is_minimum(int x, int y) const {
    const std::uint64_t here = at(x, y);
    if (here == no_shift_cost) return false;
    for (int i = 0; i < 9; ++i) {
      if (at(x + i % 3 - 1, y + i / 3 - 1) < here) return false;
    }
    return true;
  }

  int reach_x_, reach_y_;
  std::vector<std::uint64_t> costs_;
};

/// The best shift around each candidate, on pixels.
std::vector<Candidate> refined(const SearchedPicture& picture, const std::vector<Candidate>& coarse,
                               std::int32_t tolerance) {
  constexpr int side = 2 * refine_px + 1, tries = side * side;
  const int step = std::max(refine_rows, row_step(picture, most_pixels));
  const std::size_t pixels = picture.pixels() * refine_rows / size(step);
  std::vector<Candidate> all(coarse.size() * tries);
  parallel_for(static_cast<int>(all.size()), [&](int i) {
    const PatternShift from = coarse[size(i / tries)].shift;
    const int k = i % tries;
    const PatternShift s{from.x + k % side - refine_px, from.y + k / side - refine_px};
    all[size(i)] = {agreement(picture, s, step, tolerance).cost(pixels, 1), s};
  });
  std::vector<Candidate> best;
  for (auto first = all.begin(); first != all.end(); first += tries) {
    std::vector<Candidate> around(first, first + tries);
    sort_candidates(around);
    if (around.front().cost != no_shift_cost) best.push_back(around.front());
  }
  return best;
}

}  // namespace

std::vector<PatternShift> find_pattern_shifts(const Frame& frame, const Words& pixels,
                                              const PatternSettings& settings) {
  const SearchedPicture picture = whole_picture(frame, pixels);
  std::vector<Candidate> found = CoarseMap(block_means(picture), settings).minima();
  sort_candidates(found);
  found.resize(std::min(found.size(), size(settings.shifts)));
  found = refined(picture, found, settings.tolerance_quanta);
  sort_candidates(found);
  std::vector<PatternShift> shifts;
  for (const Candidate& c : found) {
    const float frame_square = static_cast<float>(c.cost) / 256;
    const PatternShift shift{c.shift.x, c.shift.y, 0, frame_square};
    if (std::find(shifts.begin(), shifts.end(), shift) != shifts.end()) continue;
    shifts.push_back(shift);
    shifts.push_back({-shift.x, -shift.y, 0, frame_square});
  }
  return shifts;
}

}  // namespace defray
