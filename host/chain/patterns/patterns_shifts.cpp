// The shifts at which a picture resembles itself: coarse search on block means, refined on pixels.
// Integers throughout: the same shifts on every device.
#include <algorithm>
#include <array>
#include <cstdlib>
#include <tuple>

#include "base/parallel.h"
#include "chain/patterns/agreement.h"
#include "chain/patterns/patterns.h"

namespace defray {
namespace {

constexpr int block = 4;                      ///< Side of the blocks of the coarse search, px.
constexpr int refine_px = 3;                  ///< Around a coarse minimum.
constexpr int refine_rows = 8;                ///< One row of so many is compared, or of more:
constexpr std::size_t most_blocks = 1 << 16;  ///< In all, of the coarse search,
constexpr std::size_t most_pixels = 1 << 16;  ///< and of the refining one.

/// A picture that is compared with itself: its frame has coc_quanta.
struct SearchedPicture {
  Frame frame;
  Words pixels;
};

/// Means over the known pixels of blocks; known are those that are at least half known.
SearchedPicture block_means(const Frame& frame, const Words& pixels) {
  SearchedPicture means;
  means.frame.width = frame.width / block;
  means.frame.height = frame.height / block;
  means.frame.coc_quanta = Quanta::room(means.frame.pixels());
  means.pixels = Words::room(means.frame.pixels());
  const auto words = pixels.host();
  const auto coc = frame.coc_quanta.host();
  const auto mean_words = means.pixels.edit();
  const auto mean_coc = means.frame.coc_quanta.edit();
  parallel_for_each(means.frame.pixels(), [&](std::size_t i) {
    const int x = static_cast<int>(i % size(means.frame.width)) * block;
    const int y = static_cast<int>(i / size(means.frame.width)) * block;
    std::array<std::uint32_t, 3> sum{};
    std::uint32_t count = 0;
    std::int64_t coc_sum = 0;
    for (int k = 0; k < block * block; ++k) {
      const std::size_t at = frame.index(x + k % block, y + k / block);
      if (!(words[at] & DEFRAY_PATTERN_KNOWN)) continue;
      ++count;
      coc_sum += coc[at];
      for (std::size_t c = 0; c < 3; ++c) sum[c] += words[at] >> (8 * c) & 255;
    }
    mean_words[i] = 2 * count < block * block ? 0 : DEFRAY_PATTERN_KNOWN;
    count = std::max(count, 1u);
    for (std::size_t c = 0; c < 3; ++c) mean_words[i] |= (sum[c] + count / 2) / count << (8 * c);
    mean_coc[i] = static_cast<std::int32_t>(coc_sum / count);
  });
  return means;
}

/// One row of how many holds no more than `most` in all.
int row_step(const Frame& frame, std::size_t most) {
  return std::max(1, static_cast<int>((frame.pixels() + most - 1) / most));
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
  CoarseMap(Backend& backend, const SearchedPicture& blocks, const PatternSettings& s)
      : reach_x_(s.reach_x_px / block),
        reach_y_(s.reach_y_px / block),
        costs_(size((2 * reach_x_ + 1) * (reach_y_ + 1))) {
    constexpr std::size_t least_share = 50;  // a fiftieth
    const int step = row_step(blocks.frame, most_blocks);
    const std::size_t all = blocks.frame.pixels() / size(step);
    std::vector<DefrayPatternShift> shifts;
    for (int y = 0; y <= reach_y_; ++y) {
      for (int x = -reach_x_; x <= reach_x_; ++x) shifts.push_back({x, y, 0, 0});
    }
    const std::vector<DefrayAgreement> sums =
        backend.patterns_agree(blocks.frame, blocks.pixels, shifts, step, s.tolerance_quanta);
    for (std::size_t i = 0; i < sums.size(); ++i) {
      costs_[i] = shift_cost(sums[i], all, all / least_share);
    }
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
std::vector<Candidate> refined(Backend& backend, const Frame& frame, const Words& pixels,
                               const std::vector<Candidate>& coarse, std::int32_t tolerance) {
  constexpr int side = 2 * refine_px + 1, tries = side * side;
  const int step = std::max(refine_rows, row_step(frame, most_pixels));
  const std::size_t compared = frame.pixels() * refine_rows / size(step);
  std::vector<DefrayPatternShift> shifts;
  for (const Candidate& from : coarse) {
    for (int k = 0; k < tries; ++k) {
      shifts.push_back(
          {from.shift.x + k % side - refine_px, from.shift.y + k / side - refine_px, 0, 0});
    }
  }
  const std::vector<DefrayAgreement> sums =
      backend.patterns_agree(frame, pixels, shifts, step, tolerance);
  std::vector<Candidate> all;
  for (std::size_t i = 0; i < sums.size(); ++i) {
    all.push_back({shift_cost(sums[i], compared, 1), {shifts[i].x, shifts[i].y}});
  }
  std::vector<Candidate> best;
  for (auto first = all.begin(); first != all.end(); first += tries) {
    std::vector<Candidate> around(first, first + tries);
    sort_candidates(around);
    if (around.front().cost != no_shift_cost) best.push_back(around.front());
  }
  return best;
}

}  // namespace

std::vector<PatternShift> find_pattern_shifts(Backend& backend, const Frame& frame,
                                              const Words& pixels,
                                              const PatternSettings& settings) {
  std::vector<Candidate> found = CoarseMap(backend, block_means(frame, pixels), settings).minima();
  sort_candidates(found);
  found.resize(std::min(found.size(), size(settings.shifts)));
  found = refined(backend, frame, pixels, found, settings.tolerance_quanta);
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
