#include "prediction/signs.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"

namespace defray {
namespace {

constexpr int levels = 5;  ///< Of windows: 3, 5, 9, 17 and 33 blocks across; 132 px.

/// Values of blocks of 4 px, of 8, and so on.
struct Level {
  int across, down;
  Plane values;

  float& at(int x, int y) { return values[size(y) * size(across) + size(x)]; }
  float at(int x, int y) const { return values[size(y) * size(across) + size(x)]; }
};

/// The largest of each four.
Level next_level(const Level& below) {
  Level next{(below.across + 1) / 2, (below.down + 1) / 2, {}};
  next.values.resize(size(next.across) * size(next.down));
  for (int y = 0; y < below.down; ++y) {
    for (int x = 0; x < below.across; ++x) {
      float& most = next.at(x / 2, y / 2);
      most = std::max(most, below.at(x, y));
    }
  }
  return next;
}

/// The largest of 3x3 each.
Level largest_around(const Level& level) {
  Level rows = level, out = level;
  for (int y = 0; y < level.down; ++y) {
    for (int x = 0; x < level.across; ++x) {
      rows.at(x, y) = std::max({level.at(std::max(0, x - 1), y), level.at(x, y),
                                level.at(std::min(level.across - 1, x + 1), y)});
    }
  }
  for (int y = 0; y < level.down; ++y) {
    for (int x = 0; x < level.across; ++x) {
      out.at(x, y) = std::max({rows.at(x, std::max(0, y - 1)), rows.at(x, y),
                               rows.at(x, std::min(level.down - 1, y + 1))});
    }
  }
  return out;
}

/// How far away blur is that arrives at a block, px, as far as windows go.
class Reaches {
 public:
  explicit Reaches(const PixelBlocks& blocks) : blocks_(blocks), around_(size(levels)) {
    Level level{blocks.across, blocks.down, {}};
    for (const PixelBlock& b : blocks.blocks) level.values.push_back(b.reach);
    for (Level& around : around_) {
      around = largest_around(level);
      level = next_level(level);
    }
  }

  float at(int x, int y) const {
    float reach = blocks_.at(x, y).reach;
    for (int level = 0; level < levels; ++level) {
      const float most = around_[size(level)].at(x >> level, y >> level);
      const float distance = static_cast<float>(block_px << level);
      if (most >= distance / 2) reach = std::max(reach, std::min(most, 2 * distance));
    }
    return reach;
  }

 private:
  const PixelBlocks& blocks_;
  std::vector<Level> around_;
};

/// Sums of moments.
class MomentSum {
 public:
  void add(const ShownMoments& m) {
    for (std::size_t c = 0; c < 3; ++c) mean_[c] += m.mean[c];
    square_ += m.square;
    ++count_;
  }
  float variance(std::size_t channels) const {
    if (count_ == 0) return 0;
    const auto count = static_cast<float>(count_);
    float means = 0;
    for (const float mean : mean_) means += mean / count * (mean / count);
    return std::max(square_ / count - means / static_cast<float>(channels), 0.0f);
  }

 private:
  std::array<float, 3> mean_{};
  float square_ = 0;
  int count_ = 0;
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
    float least = blocks_.at(x, y).least_coc, most = blocks_.at(x, y).largest_coc;
    for_each(x, y, radius, step, [&](const PixelBlock& b) {
      least = std::min(least, b.least_coc);
      most = std::max(most, b.largest_coc);
    });
    const float middle = (least + most) / 2;
    MomentSum pinhole, back, result;
    for_each(x, y, radius, step, [&](const PixelBlock& b) {
      pinhole.add(b.pinhole);
      result.add(b.result);
      if (b.mean_coc >= middle) back.add(b.pinhole);
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
          b.rim,
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
