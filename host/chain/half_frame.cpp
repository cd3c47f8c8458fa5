#include "chain/half_frame.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "lens/coc.h"

namespace defray {
namespace {

/// The two rows of pixels of a row of blocks; of an odd height the last row twice.
template <typename T>
struct RowPair {
  const T* top;
  const T* bottom;
};

template <typename T>
RowPair<T> row_pair(std::span<const T> plane, const Frame& f, int y) {
  return {&plane[f.index(0, 2 * y)], &plane[f.index(0, std::min(2 * y + 1, f.height - 1))]};
}

/// Calls visit(block, left, right) along a row of blocks, with the columns of their pixels; of an
/// odd width the last column twice.
template <typename Visit>
void for_each_block(int width, const Visit& visit) {
  const std::size_t pairs = size(width / 2);
  for (std::size_t i = 0; i < pairs; ++i) visit(i, 2 * i, 2 * i + 1);
  if (width % 2 != 0) visit(pairs, 2 * pairs, 2 * pairs);
}

/// Which of a block's four pixels has the surface that the block has: the lower median by CoC, of
/// equal ones the first; but one that has more light than the other three together, a lamp, is the
/// block's.
inline int own_pixel(const std::int32_t (&coc)[4], const float (&light)[4]) {
  const int le01 = coc[0] <= coc[1], le02 = coc[0] <= coc[2], le03 = coc[0] <= coc[3];
  const int le12 = coc[1] <= coc[2], le13 = coc[1] <= coc[3], le23 = coc[2] <= coc[3];
  // As many of the others come before each.
  const int before0 = 3 - le01 - le02 - le03, before1 = 2 + le01 - le12 - le13;
  const int before2 = 1 + le02 + le12 - le23;
  int own = before0 == 1 ? 0 : before1 == 1 ? 1 : before2 == 1 ? 2 : 3;
  const float half = (light[0] + light[1] + light[2] + light[3]) / 2;
  for (int k = 3; k >= 0; --k) own = light[k] > half ? k : own;
  return own;
}

/// Sums of the channels, alpha excepted, of a row of pixels.
void add_light(const Frame& f, std::size_t first, Plane& light) {
  light.assign(size(f.width), 0.0f);
  for (std::size_t c = 0; c < f.channels.size() - (f.has_alpha ? 1 : 0); ++c) {
    const float* const values = f.channels[c].host().data() + first;
    for (std::size_t x = 0; x < light.size(); ++x) light[x] += values[x];
  }
}

/// CoC, depth, the pixels that they are of, and detail.
class Surfaces {
 public:
  explicit Surfaces(HalfFrame& half)
      : half_(half), coc_(half.frame.pixels()), depth_(half.frame.pixels()) {
    half.source.resize(coc_.size());
    half.detail.resize(coc_.size());
    half.clear.resize(coc_.size());
  }

  void set_row(const Frame& f, int y) {
    const auto coc = row_pair(f.coc_quanta.host(), f, y);
    const auto depth = row_pair(f.depth.host(), f, y);
    const std::size_t top = f.index(0, 2 * y);
    const std::size_t bottom = f.index(0, std::min(2 * y + 1, f.height - 1));
    Plane above, below;
    add_light(f, top, above);
    add_light(f, bottom, below);
    const std::size_t begin = half_.frame.index(0, y);
    std::uint32_t* const __restrict source = &half_.source[begin];
    std::int32_t* const __restrict own_coc = &coc_[begin];
    float* const __restrict own_depth = &depth_[begin];
    float* const __restrict detail = &half_.detail[begin];
    float* const __restrict clear = &half_.clear[begin];
    for_each_block(f.width, [&](std::size_t i, std::size_t left, std::size_t right) {
      const std::int32_t c[4]{coc.top[left], coc.top[right], coc.bottom[left], coc.bottom[right]};
      const float light[4]{above[left], above[right], below[left], below[right]};
      const int own = own_pixel(c, light);
      const auto of_own = [own](auto first, auto second, auto third, auto fourth) {
        return own == 0 ? first : own == 1 ? second : own == 2 ? third : fourth;
      };
      source[i] = static_cast<std::uint32_t>(
          of_own(top + left, top + right, bottom + left, bottom + right));
      own_coc[i] = half_size_coc(of_own(c[0], c[1], c[2], c[3]));
      own_depth[i] =
          of_own(depth.top[left], depth.top[right], depth.bottom[left], depth.bottom[right]);
      float left_of_it = 0, share = 0;
      for (const std::int32_t quanta : c) {
        left_of_it += detail_left(quanta) / 4;
        share += is_clear(quanta) ? 0.25f : 0.0f;
      }
      detail[i] = left_of_it;
      clear[i] = share;
    });
  }

  void finish() {
    half_.frame.coc_quanta = std::move(coc_);
    half_.frame.depth = std::move(depth_);
  }

 private:
  HalfFrame& half_;
  std::vector<std::int32_t> coc_;
  Plane depth_;
};

/// Means of a channel's blocks, and what of them is of clear pixels.
void set_colours(RowPair<float> values, RowPair<std::int32_t> coc, const float* clear, int width,
                 float* const __restrict means, float* const __restrict clear_colour) {
  for_each_block(width, [&](std::size_t i, std::size_t left, std::size_t right) {
    const float v[4]{values.top[left], values.top[right], values.bottom[left],
                     values.bottom[right]};
    const std::int32_t c[4]{coc.top[left], coc.top[right], coc.bottom[left], coc.bottom[right]};
    const float mean = (v[0] + v[1] + v[2] + v[3]) / 4;
    float of_clear = 0;
    for (int k = 0; k < 4; ++k) of_clear += is_clear(c[k]) ? v[k] / 4 : 0.0f;
    means[i] = mean;
    clear_colour[i] = clear[i] == 1 ? mean : of_clear;
  });
}

}  // namespace

std::int32_t half_size_coc(std::int32_t coc_quanta) {
  constexpr double own = 2 << DEFRAY_COC_FRACTION_BITS;
  const double radius = tame(coc_quanta);
  const double rest = std::sqrt(std::max(radius * radius - own * own, 0.0)) / 2;
  const auto rounded = static_cast<std::int32_t>(rest + 0.5);
  return coc_quanta < 0 ? -rounded : rounded;
}

float detail_left(std::int32_t coc_quanta) {
  const float share = static_cast<float>(tame(coc_quanta)) * px_per_quantum / nothing_left_px;
  const float left = std::max(1 - share * share, 0.0f);
  return left * left;
}

HalfFrame at_half_size(const Frame& f) {
  HalfFrame half{f.without_planes(), {}, {}, {}, {}};
  Frame& h = half.frame;
  h.width = (f.width + 1) / 2;
  h.height = (f.height + 1) / 2;
  h.origin_x = f.origin_x / 2;
  h.origin_y = f.origin_y / 2;
  h.display_width = (f.display_width + 1) / 2;
  h.display_height = (f.display_height + 1) / 2;
  Surfaces surfaces(half);
  std::vector<Plane> means(f.channels.size(), Plane(h.pixels()));
  half.clear_colour = means;
  const auto coc = f.coc_quanta.host();
  parallel_for(h.height, [&](int y) {
    surfaces.set_row(f, y);
    const std::size_t first = h.index(0, y);
    for (std::size_t c = 0; c < means.size(); ++c) {
      set_colours(row_pair(f.channels[c].host(), f, y), row_pair(coc, f, y), &half.clear[first],
                  f.width, &means[c][first], &half.clear_colour[c][first]);
    }
  });
  surfaces.finish();
  for (Plane& mean : means) h.channels.emplace_back(std::move(mean));
  return half;
}

}  // namespace defray
