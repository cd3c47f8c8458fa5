// Shifts parallel to the picture at which slanting surfaces resemble themselves: all lengths in a
// geometric series, the best of them refined. Costs are integers, lengths products in one order.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "base/parallel.h"
#include "chain/patterns/agreement.h"
#include "chain/patterns/patterns.h"

namespace defray {
namespace {

constexpr int sampled_rows = 4;                ///< One row of so many is compared,
constexpr std::size_t most_samples = 1 << 15;  ///< and of its pixels no more than so many in all.
constexpr double ratio = 1.02;                 ///< From one length to the next.
constexpr int most_lengths = 512;     ///< 1.02^512: surfaces a thousand times as far as others.
constexpr int refine_steps = 8;       ///< On each side of a minimum,
constexpr double refine_by = 0.0025;  ///< of so much of its length.

/// A pixel that may be compared with another along the axis of the search.
struct Sample {
  std::size_t at;
  int left;  ///< Pixels to the end of the picture.
  float inverse;
  std::uint32_t pixel;
  std::int32_t coc;
};

struct Length {
  std::uint64_t cost;
  float parallel;  ///< As in PatternShift.
};

/// Along one axis of the picture.
class ParallelSearch {
 public:
  ParallelSearch(const Frame& frame, const Words& pixels, const PatternSettings& settings,
                 PatternShift longest)
      : width_(frame.width),
        height_(frame.height),
        coc_(frame.coc_quanta.host()),
        inverse_(frame.inverse.host()),
        pixels_(pixels.host()),
        settings_(settings),
        longest_(longest) {
    const int dx = longest.y > 0 ? 1 : 0, dy = 1 - dx;  // across the shift
    for (int y = 0; y < frame.height - dy; y += sampled_rows) {
      for (int x = 0; x < frame.width - dx; ++x) {
        if (!(pixels_[at(x, y)] & DEFRAY_PATTERN_KNOWN)) continue;
        ++known_;
        const float here = inverse_[at(x, y)], next = inverse_[at(x + dx, y + dy)];
        // Over a window of 24 px a shift of 100 px changes by 1.
        if (!(std::fabs(next - here) * 2500 > here) || !(here > 0)) continue;
        const std::size_t i = at(x, y);
        const int left = longest.y > 0 ? height_ - 1 - y : width_ - 1 - x;
        samples_.push_back({i, left, here, pixels_[i], coc_[i]});
        nearest_ = std::fmax(nearest_, here);
        farthest_ = std::fmin(farthest_, here);
      }
    }
    thin_out();
  }

  /// The best first.
  std::vector<Length> find() const {
    std::vector<float> lengths;
    const double reach = std::max(longest_.x, longest_.y);
    for (double px = DEFRAY_PATTERN_LEAST / double{nearest_};
         lengths.size() < most_lengths && px * farthest_ <= reach; px *= ratio) {
      lengths.push_back(static_cast<float>(px));
    }
    const std::vector<Length> all = costs(lengths);
    std::vector<Length> best;
    std::uint64_t most = 0;  // of all shorter ones
    for (std::size_t i = 1; i + 1 < all.size(); ++i) {
      const std::uint64_t cost = all[i].cost;
      if (cost == no_shift_cost) continue;
      const bool is_minimum = cost < all[i - 1].cost && cost <= all[i + 1].cost;
      if (is_minimum && cost < most / 2) best.push_back(refined(all[i]));
      most = std::max(most, cost);
    }
    return best;
  }

 private:
  std::size_t at(int x, int y) const { return size(y) * size(width_) + size(x); }

  /// Leaves one sample of so many that no more than most_samples are left.
  void thin_out() {
    const std::size_t step = (samples_.size() + most_samples - 1) / most_samples;
    if (step < 2) return;
    for (std::size_t i = 0; i * step < samples_.size(); ++i) samples_[i] = samples_[i * step];
    samples_.resize((samples_.size() + step - 1) / step);
    known_ /= step;
  }

  /// Of lengths that grow.
  std::vector<Length> costs(const std::vector<float>& lengths) const {
    constexpr std::size_t stretch = 1024;  // of samples
    const std::size_t stretches = (samples_.size() + stretch - 1) / stretch;
    std::vector<std::vector<DefrayAgreement>> sums(stretches);
    parallel_for(static_cast<int>(stretches), [&](int k) {
      std::vector<DefrayAgreement>& own = sums[size(k)];
      own.resize(lengths.size());
      const std::size_t first = size(k) * stretch;
      for (std::size_t i = first; i < std::min(first + stretch, samples_.size()); ++i) {
        add_sample(samples_[i], lengths, own);
      }
    });
    std::vector<Length> all;
    for (std::size_t i = 0; i < lengths.size(); ++i) {
      DefrayAgreement sum{};
      for (const auto& own : sums) {
        sum.squares += own[i].squares;
        sum.pairs += own[i].pairs;
      }
      all.push_back({shift_cost(sum, known_, (known_ + 49) / 50), lengths[i]});  // one in 50
    }
    return all;
  }

  Length refined(const Length& around) const {
    std::vector<float> lengths;
    for (int i = -refine_steps; i <= refine_steps; ++i) {
      lengths.push_back(static_cast<float>(double{around.parallel} * (1 + i * refine_by)));
    }
    const std::vector<Length> all = costs(lengths);
    return *std::min_element(all.begin(), all.end(),
                             [](const Length& a, const Length& b) { return a.cost < b.cost; });
  }

  /// Adds the pairs that a sample is one of, for all lengths: those that it has a partner at lie
  /// beside each other in the list, and many have the same.
  void add_sample(const Sample& from, const std::vector<float>& lengths,
                  std::vector<DefrayAgreement>& sums) const {
    const int most = std::max(longest_.x, longest_.y);
    const auto first = std::partition_point(lengths.begin(), lengths.end(), [&](float parallel) {
      return parallel * from.inverse < DEFRAY_PATTERN_LEAST;
    });
    int before = 0;
    DefrayAgreement pair{};
    for (auto i = static_cast<std::size_t>(first - lengths.begin()); i < lengths.size(); ++i) {
      const int length = parallel_length(lengths[i], from.inverse, most);
      if (length == 0 || length > from.left) return;  // too long, and so are all others
      if (length != before) pair = pair_at(from, length);
      before = length;
      sums[i].squares += pair.squares;
      sums[i].pairs += pair.pairs;
    }
  }

  DefrayAgreement pair_at(const Sample& from, int length) const {
    const std::size_t step = longest_.y > 0 ? size(width_) : 1;
    const std::size_t there = from.at + size(length) * step;
    if (!(pixels_[there] & DEFRAY_PATTERN_KNOWN)) return {};
    if (std::abs(std::int64_t{from.coc} - coc_[there]) > settings_.tolerance_quanta) return {};
    return {squared_difference(from.pixel, pixels_[there]), 1};
  }

  int width_, height_;
  std::span<const std::int32_t> coc_;
  std::span<const float> inverse_;
  std::span<const std::uint32_t> pixels_;
  const PatternSettings& settings_;
  PatternShift longest_;
  std::vector<Sample> samples_;
  std::uint64_t known_ = 0;
  float nearest_ = 0, farthest_ = HUGE_VALF;  ///< 1/depth of samples.
};

}  // namespace

std::vector<PatternShift> find_parallel_shifts(const Frame& frame, const Words& pixels,
                                               const PatternSettings& settings) {
  struct Found {
    std::uint64_t cost;
    PatternShift shift;
  };
  const PatternShift axes[] = {{settings.parallel_reach_x_px, 0},
                               {0, settings.parallel_reach_y_px}};
  std::array<std::optional<ParallelSearch>, 2> searches;
  parallel_for(2, [&](int i) { searches[size(i)].emplace(frame, pixels, settings, axes[i]); });
  std::vector<Found> found;
  for (int i = 0; i < 2; ++i) {
    for (const Length& l : searches[size(i)]->find()) {
      found.push_back(
          {l.cost, {axes[i].x, axes[i].y, l.parallel, static_cast<float>(l.cost) / 256}});
    }
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const Found& a, const Found& b) { return a.cost < b.cost; });
  found.resize(std::min(found.size(), size(settings.parallel_shifts)));
  std::vector<PatternShift> shifts;
  for (const Found& f : found) {
    shifts.push_back(f.shift);
    shifts.push_back({-f.shift.x, -f.shift.y, f.shift.parallel, f.shift.frame_square});
  }
  return shifts;
}

}  // namespace defray
