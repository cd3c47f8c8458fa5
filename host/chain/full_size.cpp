#include "chain/full_size.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"

namespace defray {
namespace {

/// A row at full size of a plane of half the size: of each block the left pixels and the right
/// ones. A pixel's middle lies a quarter of a block before or behind its block's.
class FullRow {
 public:
  FullRow(int width, int height)
      : count_(size((width + 1) / 2)),
        half_height_((height + 1) / 2),
        line_(count_ + 2),
        left_(count_),
        right_(count_) {}

  void set(const Plane& half, int y) {
    const int beside_y = std::clamp(y / 2 + (y % 2 ? 1 : -1), 0, half_height_ - 1);
    const float* const own = &half[size(y / 2) * count_];
    const float* const beside = &half[size(beside_y) * count_];
    float* const __restrict line = line_.data();
    for (std::size_t i = 0; i < count_; ++i) {
      line[i + 1] = own[i] + (beside[i] - own[i]) * 0.25f;
    }
    line[0] = line[1];
    line[count_ + 1] = line[count_];
    // One after the other: compilers vectorise no loop that looks at three neighbours.
    float* const __restrict left = left_.data();
    for (std::size_t i = 0; i < count_; ++i) {
      left[i] = line[i + 1] + (line[i] - line[i + 1]) * 0.25f;
    }
    float* const __restrict right = right_.data();
    for (std::size_t i = 0; i < count_; ++i) {
      right[i] = line[i + 1] + (line[i + 2] - line[i + 1]) * 0.25f;
    }
  }

  const float* left() const { return left_.data(); }
  const float* right() const { return right_.data(); }

 private:
  std::size_t count_;
  int half_height_;
  Plane line_, left_, right_;
};

/// Its pixels from left to right.
void interleave(const FullRow& row, int width, float* const __restrict out) {
  const float* const left = row.left();
  const float* const right = row.right();
  const std::size_t pairs = size(width / 2);
  for (std::size_t i = 0; i < pairs; ++i) {
    out[2 * i] = left[i];
    out[2 * i + 1] = right[i];
  }
  if (width % 2 != 0) out[2 * pairs] = left[pairs];
}

/// Rows that a channel's detail comes from; `clear` and `visible` are the same for all channels.
struct DetailRows {
  explicit DetailRows(const FullRow& row) : visible(row), clear(row), colour(row), result(row) {}
  FullRow visible, clear, colour, result;
};

/// A channel's pixel: the result, and by what is visible of it how far the frame's own is from the
/// colour of clear pixels.
inline float detailed(float result, float visible, float own, float colour, float clear,
                      std::int32_t coc) {
  const float change = (is_clear(coc) ? visible : 0.0f) * (own - colour / clear);
  const float with = std::max(result + change, std::min(own, 0.0f));
  return std::fabs(change) < INFINITY ? with : result;
}

void add_detail(const DetailRows& rows, const float* own, const std::int32_t* coc, int width,
                float* const __restrict out) {
  const auto left = [&](std::size_t i) {
    return detailed(rows.result.left()[i], rows.visible.left()[i], own[2 * i],
                    rows.colour.left()[i], rows.clear.left()[i], coc[2 * i]);
  };
  const auto right = [&](std::size_t i) {
    return detailed(rows.result.right()[i], rows.visible.right()[i], own[2 * i + 1],
                    rows.colour.right()[i], rows.clear.right()[i], coc[2 * i + 1]);
  };
  const std::size_t pairs = size(width / 2);
  for (std::size_t i = 0; i < pairs; ++i) {
    const float a = left(i), b = right(i);
    out[2 * i] = a;
    out[2 * i + 1] = b;
  }
  if (width % 2 != 0) out[2 * pairs] = left(pairs);
}

}  // namespace

Plane at_full_size(const Plane& half, int width, int height) {
  Plane out(size(width) * size(height));
  parallel_for(height, [&](int y) {
    FullRow row(width, height);
    row.set(half, y);
    interleave(row, width, &out[size(y) * size(width)]);
  });
  return out;
}

std::vector<Plane> with_detail(const Frame& f, const HalfFrame& half,
                               const std::vector<Plane>& results, const Plane& visible) {
  std::vector<Plane> out(results.size());
  parallel_for(static_cast<int>(out.size()), [&](int c) { out[size(c)].resize(f.pixels()); });
  std::vector<std::span<const float>> own;
  for (const Values<float>& channel : f.channels) own.push_back(channel.host());
  const auto coc = f.coc_quanta.host();
  parallel_for(f.height, [&](int y) {
    DetailRows rows(FullRow(f.width, f.height));
    rows.visible.set(visible, y);
    rows.clear.set(half.clear, y);
    const std::size_t first = f.index(0, y);
    for (std::size_t c = 0; c < out.size(); ++c) {
      rows.colour.set(half.clear_colour[c], y);
      rows.result.set(results[c], y);
      add_detail(rows, &own[c][first], &coc[first], f.width, &out[c][first]);
    }
  });
  return out;
}

}  // namespace defray
