#include "prediction/blocks.h"

#include <algorithm>
#include <cmath>

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

/// A row of blocks: sums over the rows of its pixels, column by column.
class BlockRow {
 public:
  BlockRow(const Frame& frame, const std::vector<Plane>& result, const Plane& confidence)
      : width_(size(frame.width)), strip_(frame, result), confidence_(confidence) {
    for (Plane* row : {&gradient_, &pinhole_gradient_, &grain_, &edge_, &brightest_}) {
      row->resize(width_);
    }
  }

  /// Blocks of the rows from y0 on, `rows` of them in the frame.
  void find(int y0, int rows, PixelBlock* blocks) {
    strip_.load(y0);
    for (Plane& sum : sums_) sum.assign(width_, 0.0f);
    for (int j = 0; j < rows; ++j) add_row(j, &confidence_[size(y0 + j) * width_]);
    for (std::size_t x0 = 0; x0 < width_; x0 += block_px) {
      set_block(x0, std::min(width_, x0 + block_px), rows, blocks[x0 / block_px]);
    }
  }

 private:
  void add_row(int j, const float* confidence) {
    find_gradient(strip_.result, j, gradient_);
    find_gradient(strip_.pinhole, j, pinhole_gradient_);
    find_grain(strip_.pinhole, j, grain_);
    find_range(strip_.coc, j, edge_);
    find_largest(strip_.brightest, j, brightest_);
    const float* const coc = strip_.coc.row(j);
    for (std::size_t x = 0; x < width_; ++x) {
      const float radius = std::fabs(coc[x]), unseen = 1 - confidence[x];
      const float edge = edge_[x] < 1 ? edge_[x] : 1.0f, gradient = gradient_[x];
      const float rim = brightest_[x] > white ? gradient : 0.0f;
      const float calm_grain = brightest_[x] > white ? 0.0f : grain_[x];
      const bool is_slight = radius >= slight_px && radius < blurred_px;
      const float values[block_means.size()] = {
          coc[x],
          unseen,
          unseen * unseen,
          edge,
          rim,
          brightest_[x] > far_beyond_white ? gradient : 0.0f,
          rim * unseen,
          radius < slight_px ? calm_grain : 0.0f,
          is_slight ? calm_grain : 0.0f,
          radius >= soft_px && radius < wide_px ? calm_grain : 0.0f,
          radius >= slight_px && radius < soft_px ? gradient - rim : 0.0f,
          pinhole_gradient_[x] * edge,
          grain_[x] * (radius < 1 ? radius : 1.0f)};
      for (std::size_t i = 0; i < block_means.size(); ++i) sums_[i][x] += values[i];
    }
  }

  void set_block(std::size_t first, std::size_t end, int rows, PixelBlock& b) const {
    const float share = 1 / static_cast<float>((end - first) * size(rows));
    for (std::size_t i = 0; i < block_means.size(); ++i) {
      for (std::size_t x = first; x < end; ++x) b.*block_means[i] += sums_[i][x] * share;
    }
    b.least_coc = b.largest_coc = strip_.coc.row(0)[first];
    for (int j = 0; j < rows; ++j) {
      for (std::size_t x = first; x < end; ++x) {
        b.least_coc = std::min(b.least_coc, strip_.coc.row(j)[x]);
        b.largest_coc = std::max(b.largest_coc, strip_.coc.row(j)[x]);
      }
    }
    b.reach = std::max(-b.least_coc, b.largest_coc);
    add_moments(strip_.pinhole, first, end, rows, share, b.pinhole);
    add_moments(strip_.result, first, end, rows, share, b.result);
  }

  static void add_moments(const std::vector<StripRows>& shown, std::size_t first, std::size_t end,
                          int rows, float share, ShownMoments& moments) {
    for (std::size_t c = 0; c < shown.size(); ++c) {
      float sum = 0, squares = 0;
      for (int j = 0; j < rows; ++j) {
        const float* const row = shown[c].row(j);
        for (std::size_t x = first; x < end; ++x) {
          sum += row[x];
          squares += row[x] * row[x];
        }
      }
      moments.mean[c] = sum * share;
      moments.square += squares * share / static_cast<float>(shown.size());
    }
  }

  std::size_t width_;
  Strip strip_;
  const Plane& confidence_;
  std::array<Plane, block_means.size()> sums_;
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
