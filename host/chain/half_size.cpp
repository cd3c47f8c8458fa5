#include "chain/half_size.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/parallel.h"
#include "base/stopwatch.h"
#include "lens/coc.h"

namespace defray {
namespace {

/// The pixels of a block, by index.
std::array<std::size_t, 4> block_of(const Frame& f, int x, int y) {
  const int x0 = 2 * x, y0 = 2 * y;
  const int x1 = std::min(x0 + 1, f.width - 1), y1 = std::min(y0 + 1, f.height - 1);
  return {f.index(x0, y0), f.index(x1, y0), f.index(x0, y1), f.index(x1, y1)};
}

/// The pixel of a block whose surface the block has: the lower median by CoC, of equal ones the
/// first; but one that has more light than the other three together, a lamp, is the block's.
std::size_t source_of(const std::array<std::size_t, 4>& block, std::span<const std::int32_t> coc,
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

/// Every pixel opaque.
bool is_opaque(const Frame& f) {
  const auto alpha = f.channels.back().host();
  return f.has_alpha && std::all_of(alpha.begin(), alpha.end(), [](float a) { return a == 1.0f; });
}

/// What the half frame's chain gives, and how much of each pixel's detail is to be seen.
struct HalfResult {
  MethodResult result;
  Plane visible;
};

/// `visible` goes through the lens as a channel: in the place of an alpha that is 1 everywhere,
/// beside three others, or else alone.
HalfResult through_lens(HalfFrame& half, bool is_opaque, const ChainSettings& settings,
                        Stages& stages, bool wants_nearest, const Progress& progress) {
  Frame& f = half.frame;
  Planes own = f.channels;
  if (is_opaque) f.channels.pop_back();
  const bool has_alpha = f.has_alpha && !is_opaque;
  const bool has_room = f.channels.size() < 4 && !has_alpha;
  f.has_alpha = has_alpha;
  if (has_room) f.channels.emplace_back(half.detail);
  HalfResult out{run_chain(f, settings, stages, wants_nearest, progress), {}};
  std::vector<Plane>& colour = out.result.colour;
  if (has_room) {
    out.visible = std::move(colour.back());
    colour.pop_back();
  } else {
    f.channels = {Values<float>(half.detail)};
    f.has_alpha = false;
    ChainSettings plain = settings;
    plain.highlights = false;
    out.visible = run_chain(f, plain, stages).colour[0];
  }
  if (is_opaque) colour.emplace_back(f.pixels(), 1.0f);
  f.channels = std::move(own);
  return out;
}

/// The result with the detail that the half frame lost, but nothing darker than black.
Plane with_detail(const Values<float>& pinhole, const Values<float>& half_pinhole,
                  const Plane& half_result, const Plane& half_visible, int width, int height) {
  const FullRows bases(half_pinhole.host(), width, height), results(half_result, width, height);
  const FullRows shares(half_visible, width, height);
  const auto sharp = pinhole.host();
  Plane out(sharp.size());
  parallel_for(height, [&](int y) {
    Plane base = bases.room(), result = bases.room(), visible = bases.room();
    bases.row(y, base);
    results.row(y, result);
    shares.row(y, visible);
    const std::size_t first = size(y) * size(width);
    for (std::size_t x = 0; x < size(width); ++x) {
      const float own = sharp[first + x], change = visible[x] * (own - base[x]);
      const float detailed = std::max(result[x] + change, std::min(own, 0.0f));
      out[first + x] = std::isfinite(change) ? detailed : result[x];
    }
  });
  return out;
}

/// Each value for 2x2.
Plane doubled(const Plane& half, int width, int height) {
  Plane out;
  for (int y = 0; y < height; ++y) {
    const std::size_t row = size(y / 2) * size((width + 1) / 2);
    for (int x = 0; x < width; ++x) out.push_back(half[row + size(x / 2)]);
  }
  return out;
}

}  // namespace

std::int32_t half_size_coc(std::int32_t coc_quanta) {
  constexpr double own = 2 << DEFRAY_COC_FRACTION_BITS;
  const double radius = tame(coc_quanta);
  const double rest = std::sqrt(std::fmax(radius * radius - own * own, 0.0)) / 2;
  return static_cast<std::int32_t>(std::lround(std::copysign(rest, radius)));
}

float detail_left(std::int32_t coc_quanta) {
  constexpr float nothing_left_px = 1.75f;
  const float share = static_cast<float>(tame(coc_quanta)) * px_per_quantum / nothing_left_px;
  const float left = std::fmax(1 - share * share, 0.0f);
  return left * left;
}

HalfFrame at_half_size(const Frame& f) {
  HalfFrame half{f.without_planes(), {}, {}};
  Frame& h = half.frame;
  h.width = (f.width + 1) / 2;
  h.height = (f.height + 1) / 2;
  h.origin_x = f.origin_x / 2;
  h.origin_y = f.origin_y / 2;
  h.display_width = (f.display_width + 1) / 2;
  h.display_height = (f.display_height + 1) / 2;
  const auto coc_quanta = f.coc_quanta.host();
  const auto depth = f.depth.host();
  std::vector<std::span<const float>> light;
  for (const Values<float>& channel : f.channels) light.push_back(channel.host());
  if (f.has_alpha) light.pop_back();
  half.source.resize(h.pixels());
  half.detail.resize(h.pixels());
  std::vector<std::int32_t> coc(h.pixels());
  Plane z(h.pixels());
  parallel_for(h.height, [&](int y) {
    for (int x = 0; x < h.width; ++x) {
      const auto block = block_of(f, x, y);
      const std::size_t i = h.index(x, y), source = source_of(block, coc_quanta, light);
      half.source[i] = static_cast<std::uint32_t>(source);
      coc[i] = half_size_coc(coc_quanta[source]);
      z[i] = depth[source];
      float detail = 0;
      for (const std::size_t pixel : block) detail += detail_left(coc_quanta[pixel]);
      half.detail[i] = detail / 4;
    }
  });
  h.coc_quanta = std::move(coc);
  h.depth = std::move(z);
  for (const Values<float>& channel : f.channels) {
    const auto values = channel.host();
    Plane means(h.pixels());
    parallel_for(h.height, [&](int y) {
      for (int x = 0; x < h.width; ++x) {
        const auto b = block_of(f, x, y);
        means[h.index(x, y)] = (values[b[0]] + values[b[1]] + values[b[2]] + values[b[3]]) / 4;
      }
    });
    h.channels.emplace_back(std::move(means));
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

MethodResult run_half_size(const Frame& f, const ChainSettings& settings, Stages& stages,
                           bool wants_nearest, const Progress& progress) {
  Stopwatch watch;
  HalfFrame half = at_half_size(f);
  const bool opaque = is_opaque(f);
  const double halving = watch.lap();
  HalfResult made = through_lens(half, opaque, settings, stages, wants_nearest, progress);
  watch.lap();
  MethodResult& out = made.result;
  for (std::size_t c = 0; c < out.colour.size(); ++c) {
    const bool is_constant = opaque && c + 1 == out.colour.size();
    out.colour[c] = is_constant ? Plane(f.pixels(), 1.0f)
                                : with_detail(f.channels[c], half.frame.channels[c], out.colour[c],
                                              made.visible, f.width, f.height);
  }
  out.confidence = at_full_size(out.confidence, f.width, f.height);
  out.tile_classes = doubled(out.tile_classes, f.width, f.height);
  if (wants_nearest) {
    std::vector<std::uint32_t> nearest(f.pixels());
    for (std::size_t i = 0; i < nearest.size(); ++i) {
      const int x = static_cast<int>(i % size(f.width)), y = static_cast<int>(i / size(f.width));
      const std::uint32_t from = out.nearest[half.frame.index(x / 2, y / 2)];
      const bool is_own = from == half.frame.index(x / 2, y / 2);
      nearest[i] = is_own ? static_cast<std::uint32_t>(i) : half.source[from];
    }
    out.nearest = std::move(nearest);
  }
  out.report.stages.insert(out.report.stages.begin(), {"half size", halving, 0});
  out.report.stages.push_back({"full size", watch.lap(), 0});
  return std::move(made.result);
}

}  // namespace defray
