#include "chain/half_frame.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/parallel.h"
#include "lens/coc.h"

namespace defray {
namespace {

/// A disc of this radius leaves nothing of the finest detail.
constexpr float nothing_left_px = 1.75f;
constexpr auto nothing_left_quanta =
    static_cast<std::int32_t>(nothing_left_px * (1 << DEFRAY_COC_FRACTION_BITS));

/// Not nearer than the focus and blurred beyond all detail: through that shows what lies behind,
/// but the pinhole picture has its sharp edges there, which show nowhere.
bool is_clear(std::int32_t coc_quanta) { return coc_quanta > -nothing_left_quanta; }

/// Its pixels, by index.
using Block = std::array<std::size_t, 4>;

/// Calls visit(block, pixel of the half frame), on all cores.
template <typename Visit>
void for_each_block(const Frame& f, const Frame& half, const Visit& visit) {
  parallel_for(half.height, [&](int y) {
    const int y0 = 2 * y, y1 = std::min(y0 + 1, f.height - 1);
    for (int x = 0; x < half.width; ++x) {
      const int x0 = 2 * x, x1 = std::min(x0 + 1, f.width - 1);
      visit(Block{f.index(x0, y0), f.index(x1, y0), f.index(x0, y1), f.index(x1, y1)},
            half.index(x, y));
    }
  });
}

/// The pixel of a block whose surface the block has: the lower median by CoC, of equal ones the
/// first; but one that has more light than the other three together, a lamp, is the block's.
std::size_t source_of(const Block& block, std::span<const std::int32_t> coc,
                      const std::vector<std::span<const float>>& light) {
  std::array<float, 4> lights{};
  for (std::size_t i = 0; i < 4; ++i) {
    for (const auto& channel : light) lights[i] += channel[block[i]];
  }
  const float half = (lights[0] + lights[1] + lights[2] + lights[3]) / 2;
  std::size_t median = block[0];
  for (std::size_t i = 0; i < 4; ++i) {
    if (lights[i] > half) return block[i];
    int before = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      before += coc[block[k]] < coc[block[i]] || (coc[block[k]] == coc[block[i]] && k < i);
    }
    if (before == 1) median = block[i];
  }
  return median;
}

/// Rows of a plane at full size: linear between the middles of blocks. A pixel's middle lies a
/// quarter of a block before or behind its block's.
class FullRows {
 public:
  FullRows(std::span<const float> half, int width, int height)
      : half_(half), half_width_((width + 1) / 2), half_height_((height + 1) / 2) {}

  /// One value more where the width is odd.
  Plane room() const { return Plane(size(2 * half_width_)); }

  void row(int y, Plane& out) const {
    const int beside_y = std::clamp(y / 2 + (y % 2 ? 1 : -1), 0, half_height_ - 1);
    const float* const own = &half_[size(y / 2) * size(half_width_)];
    const float* const beside = &half_[size(beside_y) * size(half_width_)];
    Plane line(size(half_width_) + 2);
    for (std::size_t i = 0; i < size(half_width_); ++i) {
      line[i + 1] = own[i] + (beside[i] - own[i]) * 0.25f;
    }
    line.front() = line[1];
    line.back() = line[size(half_width_)];
    for (std::size_t i = 0; i < size(half_width_); ++i) {
      const float here = line[i + 1];
      out[2 * i] = here + (line[i] - here) * 0.25f;
      out[2 * i + 1] = here + (line[i + 2] - here) * 0.25f;
    }
  }

 private:
  std::span<const float> half_;
  int half_width_, half_height_;
};

/// CoC, depth, the pixels that they are of, and detail.
void set_surfaces(const Frame& f, HalfFrame& half) {
  const auto coc_quanta = f.coc_quanta.host();
  const auto depth = f.depth.host();
  std::vector<std::span<const float>> light;
  for (const Values<float>& channel : f.channels) light.push_back(channel.host());
  if (f.has_alpha) light.pop_back();
  const std::size_t count = half.frame.pixels();
  half.source.resize(count);
  half.detail.resize(count);
  half.clear.resize(count);
  std::vector<std::int32_t> coc(count);
  Plane z(count);
  for_each_block(f, half.frame, [&](const Block& block, std::size_t i) {
    const std::size_t source = source_of(block, coc_quanta, light);
    half.source[i] = static_cast<std::uint32_t>(source);
    coc[i] = half_size_coc(coc_quanta[source]);
    z[i] = depth[source];
    for (const std::size_t pixel : block) {
      half.detail[i] += detail_left(coc_quanta[pixel]) / 4;
      half.clear[i] += is_clear(coc_quanta[pixel]) ? 0.25f : 0.0f;
    }
  });
  half.frame.coc_quanta = std::move(coc);
  half.frame.depth = std::move(z);
}

}  // namespace

std::int32_t half_size_coc(std::int32_t coc_quanta) {
  constexpr double own = 2 << DEFRAY_COC_FRACTION_BITS;
  const double radius = tame(coc_quanta);
  const double rest = std::sqrt(std::fmax(radius * radius - own * own, 0.0)) / 2;
  return static_cast<std::int32_t>(std::lround(std::copysign(rest, radius)));
}

float detail_left(std::int32_t coc_quanta) {
  const float share = static_cast<float>(tame(coc_quanta)) * px_per_quantum / nothing_left_px;
  const float left = std::fmax(1 - share * share, 0.0f);
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
  set_surfaces(f, half);
  const auto coc = f.coc_quanta.host();
  for (const Values<float>& channel : f.channels) {
    const auto values = channel.host();
    Plane means(h.pixels()), clear(h.pixels());
    for_each_block(f, h, [&](const Block& b, std::size_t i) {
      means[i] = (values[b[0]] + values[b[1]] + values[b[2]] + values[b[3]]) / 4;
      if (half.clear[i] == 1) {
        clear[i] = means[i];
        return;
      }
      for (const std::size_t pixel : b) {
        if (is_clear(coc[pixel])) clear[i] += values[pixel] / 4;
      }
    });
    h.channels.emplace_back(std::move(means));
    half.clear_colour.push_back(std::move(clear));
  }
  return half;
}

Plane at_full_size(const Plane& half, int width, int height) {
  const FullRows rows(half, width, height);
  Plane out(size(width) * size(height));
  parallel_for(height, [&](int y) {
    Plane row = rows.room();
    rows.row(y, row);
    std::copy_n(row.begin(), width, out.begin() + std::int64_t{y} * width);
  });
  return out;
}

Plane with_detail(const Frame& f, const HalfFrame& half, std::size_t channel,
                  const Plane& half_result, const Plane& half_visible) {
  const int width = f.width;
  const FullRows colours(half.clear_colour[channel], width, f.height);
  const FullRows clears(half.clear, width, f.height);
  const FullRows results(half_result, width, f.height), shares(half_visible, width, f.height);
  const auto sharp = f.channels[channel].host();
  const auto coc = f.coc_quanta.host();
  Plane out(sharp.size());
  parallel_for(f.height, [&](int y) {
    Plane colour = colours.room(), clear = clears.room();
    Plane result = results.room(), visible = shares.room();
    colours.row(y, colour);
    clears.row(y, clear);
    results.row(y, result);
    shares.row(y, visible);
    const std::size_t first = size(y) * size(width);
    for (std::size_t x = 0; x < size(width); ++x) {
      const float seen = visible[x], share = is_clear(coc[first + x]) ? seen : 0.0f;
      const float own = sharp[first + x], change = share * (own - colour[x] / clear[x]);
      const float detailed = std::max(result[x] + change, std::min(own, 0.0f));
      out[first + x] = std::isfinite(change) ? detailed : result[x];
    }
  });
  return out;
}

}  // namespace defray
