#include "prediction/signs.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"

namespace defray {
namespace {

/// Blocks of 4 px, of 8, and so on, with the largest reach of each.
std::vector<Plane> reach_pyramid(const PixelBlocks& blocks, int levels) {
  std::vector<Plane> pyramid{Plane(blocks.blocks.size())};
  for (std::size_t i = 0; i < blocks.blocks.size(); ++i) pyramid[0][i] = blocks.blocks[i].reach;
  int across = blocks.across, down = blocks.down;
  while (static_cast<int>(pyramid.size()) < levels) {
    const int wide = (across + 1) / 2, high = (down + 1) / 2;
    Plane next(size(wide) * size(high));
    for (int y = 0; y < down; ++y) {
      for (int x = 0; x < across; ++x) {
        float& most = next[size(y / 2) * size(wide) + size(x / 2)];
        most = std::max(most, pyramid.back()[size(y) * size(across) + size(x)]);
      }
    }
    pyramid.push_back(std::move(next));
    across = wide;
    down = high;
  }
  return pyramid;
}

constexpr int levels = 5;  ///< Of windows: 3, 5, 9, 17 and 33 blocks across; 132 px.

/// How far away blur is that arrives at a block, px, as far as windows go.
class Reaches {
 public:
  explicit Reaches(const PixelBlocks& blocks)
      : across_(blocks.across), down_(blocks.down), pyramid_(reach_pyramid(blocks, levels)) {}

  float at(int x, int y) const {
    float reach = pyramid_[0][size(y) * size(across_) + size(x)];
    int across = across_, down = down_;
    for (int level = 0; level < levels; ++level) {
      float most = 0;
      const int i = x >> level, j = y >> level;
      for (int k = std::max(0, j - 1); k <= std::min(down - 1, j + 1); ++k) {
        for (int l = std::max(0, i - 1); l <= std::min(across - 1, i + 1); ++l) {
          most = std::max(most, pyramid_[size(level)][size(k) * size(across) + size(l)]);
        }
      }
      const float distance = static_cast<float>(block_px << level);
      if (most >= distance / 2) reach = std::max(reach, std::min(most, 2 * distance));
      across = (across + 1) / 2;
      down = (down + 1) / 2;
    }
    return reach;
  }

 private:
  int across_, down_;
  std::vector<Plane> pyramid_;
};

/// Sums of weighted moments.
class MomentSum {
 public:
  void add(const ShownMoments& m, float weight) {
    for (std::size_t c = 0; c < 3; ++c) mean_[c] += weight * m.mean[c];
    square_ += weight * m.square;
    weight_ += weight;
  }
  float variance(std::size_t channels) const {
    if (weight_ == 0) return 0;
    float means = 0;
    for (const float mean : mean_) means += mean / weight_ * (mean / weight_);
    return std::max(square_ / weight_ - means / static_cast<float>(channels), 0.0f);
  }

 private:
  std::array<float, 3> mean_{};
  float square_ = 0, weight_ = 0;
};

/// Variances of shown values in a window: of the pinhole picture, of what lies at the back of it
/// alone, of the result.
struct Variances {
  float pinhole, back, result;
};

class Windows {
 public:
  Windows(const PixelBlocks& blocks, std::size_t channels) : blocks_(blocks), channels_(channels) {}

  /// Around a block, as wide as the reach.
  Variances around(int x, int y, float reach) const {
    int level = 0;
    while (level + 1 < levels && reach > static_cast<float>(block_px << level)) ++level;
    const int radius = 1 << level, step = std::max(1, radius / 2);
    float least = 0, most = 0;
    bool is_first = true;
    for_each(x, y, radius, step, [&](const PixelBlock& b) {
      least = is_first ? b.least_coc : std::min(least, b.least_coc);
      most = is_first ? b.largest_coc : std::max(most, b.largest_coc);
      is_first = false;
    });
    const float middle = (least + most) / 2;
    MomentSum pinhole, back, result;
    for_each(x, y, radius, step, [&](const PixelBlock& b) {
      pinhole.add(b.pinhole, 1);
      result.add(b.result, 1);
      if (b.mean_coc >= middle) back.add(b.pinhole, 1);
    });
    return {pinhole.variance(channels_), back.variance(channels_), result.variance(channels_)};
  }

 private:
  template <typename Visit>
  void for_each(int x, int y, int radius, int step, const Visit& visit) const {
    for (int j = y - radius; j <= y + radius; j += step) {
      if (j < 0 || j >= blocks_.down) continue;
      for (int i = x - radius; i <= x + radius; i += step) {
        if (i >= 0 && i < blocks_.across) visit(blocks_.at(i, j));
      }
    }
  }

  const PixelBlocks& blocks_;
  std::size_t channels_;
};

/// In the model's order.
SignValues signs_of(const PixelBlock& b, const Variances& v, float reach) {
  return {v.pinhole * std::min(reach / 4, 1.0f),
          b.unseen_square * v.back,
          b.unseen_square * v.back,
          b.unseen * v.back,
          b.unseen * v.result,
          b.rim,
          b.bright_rim,
          b.unseen_rim,
          b.edge * b.edge * b.edge * v.back,
          b.edge_gradient,
          b.sharp_grain,
          b.slight_grain,
          b.soft_grain,
          b.slight_gradient,
          b.lost_grain};
}

}  // namespace

std::vector<SignValues> signs_of(const PixelBlocks& blocks, std::size_t channels, Rows rows) {
  const Reaches reaches(blocks);
  const Windows windows(blocks, channels);
  std::vector<SignValues> out(size(rows.count()) * size(blocks.across));
  parallel_for(rows.count(), [&](int j) {
    const int y = rows.y + j;
    for (int x = 0; x < blocks.across; ++x) {
      const float reach = reaches.at(x, y);
      out[size(j) * size(blocks.across) + size(x)] =
          signs_of(blocks.at(x, y), windows.around(x, y, reach), reach);
    }
  });
  return out;
}

}  // namespace defray
