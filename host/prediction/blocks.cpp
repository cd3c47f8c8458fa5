#include "prediction/blocks.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/parallel.h"
#include "prediction/strip.h"

namespace defray {
namespace {

constexpr float slight_px = 0.3f, blurred_px = 1, soft_px = 2.5f, wide_px = 6;
constexpr float white = 1, far_beyond_white = 4;

/// What is a mean over a block's pixels, in the order in which BlockRow adds it up.
constexpr std::array block_means{&PixelBlock::mean_coc,
                                 &PixelBlock::unseen,
                                 &PixelBlock::unseen_square,
                                 &PixelBlock::edge,
                                 &PixelBlock::rim,
                                 &PixelBlock::bright_rim,
                                 &PixelBlock::unseen_rim,
                                 &PixelBlock::sharp_grain,
                                 &PixelBlock::slight_grain,
                                 &PixelBlock::soft_grain,
                                 &PixelBlock::slight_gradient,
                                 &PixelBlock::edge_gradient,
                                 &PixelBlock::lost_grain};

/// sum[x] += value(x) along a row. One sum a loop: of such loops compilers make vectors.
template <typename Value>
void add(Plane& sum, const Value& value) {
  float* const __restrict to = sum.data();
  for (std::size_t x = 0, width = sum.size(); x < width; ++x) to[x] += value(x);
}

/// Sums of shown values and of their squares, a value a column.
struct MomentSums {
  explicit MomentSums(std::size_t width) : squares(width) { channels.fill(Plane(width)); }

  void clear() {
    for (Plane& channel : channels) std::fill(channel.begin(), channel.end(), 0.0f);
    std::fill(squares.begin(), squares.end(), 0.0f);
  }

  void add_row(const std::vector<StripRows>& shown, int j) {
    for (std::size_t c = 0; c < shown.size(); ++c) {
      const float* const row = shown[c].row(j);
      add(channels[c], [row](std::size_t x) { return row[x]; });
      add(squares, [row](std::size_t x) { return row[x] * row[x]; });
    }
  }

  std::array<Plane, 3> channels;
  Plane squares;
};

/// A row of blocks: sums over the rows of its pixels, column by column.
class BlockRow {
 public:
  BlockRow(const Frame& frame, const std::vector<Plane>& result, const Plane& confidence)
      : width_(size(frame.width)),
        strip_(frame, result),
        confidence_(confidence),
        pinhole_(width_),
        result_(width_),
        least_coc_(width_),
        largest_coc_(width_) {
    sums_.fill(Plane(width_));
    for (Plane* row : {&gradient_, &pinhole_gradient_, &grain_, &edge_, &brightest_}) {
      row->resize(width_);
    }
  }

  /// Blocks of the rows from y0 on, `rows` of them in the frame.
  void find(int y0, int rows, PixelBlock* blocks) {
    strip_.load(y0);
    for (Plane& sum : sums_) std::fill(sum.begin(), sum.end(), 0.0f);
    pinhole_.clear(), result_.clear();
    std::copy_n(strip_.coc.row(0), width_, least_coc_.begin());
    largest_coc_ = least_coc_;
    for (int j = 0; j < rows; ++j) add_row(j, &confidence_[size(y0 + j) * width_]);
    set_means(rows, blocks);
    set_moments(pinhole_, rows, &PixelBlock::pinhole, blocks);
    set_moments(result_, rows, &PixelBlock::result, blocks);
    for (std::size_t x = 0; x < width_; x += block_px) set_range(x, blocks[x / block_px]);
  }

 private:
  void add_row(int j, const float* confidence) {
    find_gradient(strip_.result, j, gradient_);
    find_gradient(strip_.pinhole, j, pinhole_gradient_);
    find_grain(strip_.pinhole, j, grain_);
    find_range(strip_.coc, j, edge_);
    find_largest(strip_.brightest, j, brightest_);
    pinhole_.add_row(strip_.pinhole, j);
    result_.add_row(strip_.result, j);
    add_coc(strip_.coc.row(j), confidence);
    add_rims(confidence);
    add_grain(strip_.coc.row(j));
  }

  void add_coc(const float* coc, const float* confidence) {
    float* const __restrict least = least_coc_.data(), * const __restrict most =
                                                           largest_coc_.data();
    for (std::size_t x = 0; x < width_; ++x) least[x] = coc[x] < least[x] ? coc[x] : least[x];
    for (std::size_t x = 0; x < width_; ++x) most[x] = coc[x] > most[x] ? coc[x] : most[x];
    add(sums_[0], [coc](std::size_t x) { return coc[x]; });
    add(sums_[1], [confidence](std::size_t x) { return 1 - confidence[x]; });
    add(sums_[2],
        [confidence](std::size_t x) { return (1 - confidence[x]) * (1 - confidence[x]); });
  }

  void add_rims(const float* confidence) {
    const float *edges = edge_.data(), *bright = brightest_.data(), *gradient = gradient_.data();
    const float* const pinhole_gradient = pinhole_gradient_.data();
    const auto edge = [edges](std::size_t x) { return edges[x] < 1 ? edges[x] : 1.0f; };
    const auto rim = [bright, gradient](float beyond, std::size_t x) {
      const float value = gradient[x];
      return bright[x] > beyond ? value : 0.0f;
    };
    add(sums_[3], edge);
    add(sums_[4], [rim](std::size_t x) { return rim(white, x); });
    add(sums_[5], [rim](std::size_t x) { return rim(far_beyond_white, x); });
    add(sums_[6], [rim, confidence](std::size_t x) { return rim(white, x) * (1 - confidence[x]); });
    add(sums_[11],
        [pinhole_gradient, edge](std::size_t x) { return pinhole_gradient[x] * edge(x); });
  }

  void add_grain(const float* coc) {
    const float *grain = grain_.data(), *bright = brightest_.data(), *gradient = gradient_.data();
    // Of what is not beyond white, where the radius is of these.
    const auto within = [coc, bright](const float* values, float least, float end) {
      return [=](std::size_t x) {
        const float radius = std::fabs(coc[x]), value = values[x];
        const float calm = bright[x] > white ? 0.0f : value;
        const float below = radius < end ? calm : 0.0f;
        return radius >= least ? below : 0.0f;
      };
    };
    add(sums_[7], within(grain, 0, slight_px));
    add(sums_[8], within(grain, slight_px, blurred_px));
    add(sums_[9], within(grain, soft_px, wide_px));
    add(sums_[10], within(gradient, slight_px, soft_px));
    add(sums_[12], [grain, coc](std::size_t x) {
      const float radius = std::fabs(coc[x]);
      return grain[x] * (radius < 1 ? radius : 1.0f);
    });
  }

  /// Means over `rows` of a block each.
  template <typename Set>
  void for_each_mean(const Plane& sums, int rows, const Set& set) const {
    const std::size_t whole = width_ / block_px;
    const float share = 1 / static_cast<float>(block_px * rows);
    const float* sum = sums.data();
    for (std::size_t k = 0; k < whole; ++k, sum += block_px) {
      set(k, ((sum[0] + sum[1]) + (sum[2] + sum[3])) * share);
    }
    if (const std::size_t left = width_ % block_px) {
      set(whole, std::accumulate(sum, sum + left, 0.0f) / static_cast<float>(left * size(rows)));
    }
  }

  void set_means(int rows, PixelBlock* blocks) const {
    for (std::size_t i = 0; i < block_means.size(); ++i) {
      float PixelBlock::*const member = block_means[i];
      for_each_mean(sums_[i], rows, [=](std::size_t k, float mean) { blocks[k].*member = mean; });
    }
  }

  void set_moments(const MomentSums& sums, int rows, ShownMoments PixelBlock::*moments,
                   PixelBlock* blocks) const {
    for (std::size_t c = 0; c < strip_.channels(); ++c) {
      for_each_mean(sums.channels[c], rows,
                    [=](std::size_t k, float mean) { (blocks[k].*moments).mean[c] = mean; });
    }
    const auto channels = static_cast<float>(strip_.channels());
    for_each_mean(sums.squares, rows, [=](std::size_t k, float mean) {
      (blocks[k].*moments).square = mean / channels;
    });
  }

  void set_range(std::size_t first, PixelBlock& b) const {
    const std::size_t end = std::min(width_, first + block_px);
    b.least_coc = *std::min_element(&least_coc_[first], least_coc_.data() + end);
    b.largest_coc = *std::max_element(&largest_coc_[first], largest_coc_.data() + end);
    b.reach = std::max(-b.least_coc, b.largest_coc);
  }

  std::size_t width_;
  Strip strip_;
  const Plane& confidence_;
  std::array<Plane, block_means.size()> sums_;
  MomentSums pinhole_, result_;
  Plane least_coc_, largest_coc_;
  Plane gradient_, pinhole_gradient_, grain_, edge_, brightest_;
};

}  // namespace

PixelBlocks blocks_of(const Frame& frame, const std::vector<Plane>& result, const Plane& confidence,
                      Rows rows) {
  PixelBlocks out{(frame.width + block_px - 1) / block_px, rows.count(), {}};
  out.blocks.resize(size(out.across) * size(out.down));
  constexpr int together = 8;  // rows of blocks that share their memory
  parallel_for((out.down + together - 1) / together, [&](int task) {
    BlockRow row(frame, result, confidence);
    for (int j = task * together; j < std::min(out.down, (task + 1) * together); ++j) {
      const int y0 = (rows.y + j) * block_px;
      row.find(y0, std::min(block_px, frame.height - y0), &out.blocks[size(j) * size(out.across)]);
    }
  });
  return out;
}

}  // namespace defray
