#include "prediction/strip.h"

#include <algorithm>
#include <array>
#include <bit>

#include "base/srgb.h"
#include "lens/coc.h"

namespace defray {
namespace {

/// Shown values by the leading bits of linear ones: so many steps between powers of two.
class ShownTable {
 public:
  ShownTable() {
    for (std::uint32_t i = 0; i < count; ++i) {
      const auto middle = std::bit_cast<float>(((i + first) << dropped) | (1u << (dropped - 1)));
      values_[i] = static_cast<float>(shown_value(middle));
    }
    values_[count] = 1;
  }

  float operator()(float linear) const {
    const float below_1 = linear < 1 ? linear : 1.0f;
    const float curved = below_1 >= least ? below_1 : least;
    const float on_line = (linear > 0 ? linear : 0.0f) * 12.92f;
    const float on_curve = values_[(std::bit_cast<std::uint32_t>(curved) >> dropped) - first];
    return linear >= least ? on_curve : on_line;  // no jumps: 0.8 of the time
  }

 private:
  static constexpr float least = 0x1p-9f;  ///< Below, the curve is a line.
  static constexpr int dropped = 14;       ///< Bits; 512 steps are left.
  static constexpr std::uint32_t first = std::bit_cast<std::uint32_t>(least) >> dropped;
  static constexpr std::uint32_t count = (std::bit_cast<std::uint32_t>(1.0f) >> dropped) - first;
  std::array<float, count + 1> values_;
};

const ShownTable& shown_table() {
  static const ShownTable table;
  return table;
}

/// Fills both ends of a row.
void extend(float* row, int width) {
  row[-1] = row[0];
  row[width] = row[width - 1];
}

}  // namespace

float shown(float linear) { return shown_table()(linear); }

Strip::Strip(const Frame& f, const std::vector<Plane>& lens_picture)
    : coc(f.width),
      brightest(f.width),
      width_(f.width),
      height_(f.height),
      coc_quanta_(f.coc_quanta.host()) {
  const std::size_t light = f.channels.size() - (f.has_alpha ? 1 : 0);
  for (std::size_t c = 0; c < std::min<std::size_t>(3, light); ++c) {
    pinhole_light_.push_back(f.channels[c].host());
    result_light_.emplace_back(lens_picture[c]);
  }
  pinhole.resize(pinhole_light_.size(), StripRows(f.width));
  result = pinhole;
}

void Strip::load(int y0) {
  // The last two rows of the strip above are this one's first.
  const bool goes_on = y0 == next_;
  for (int j = -1; j <= block_px; ++j) {
    if (goes_on && j < 1) {
      copy_row(j + block_px, j);
    } else {
      load_row(std::clamp(y0 + j, 0, height_ - 1), j);
    }
  }
  next_ = y0 + block_px;
}

void Strip::copy_row(int from, int to) {
  const auto copy = [&](StripRows& rows) {
    std::copy_n(rows.row(from) - 1, width_ + 2, rows.row(to) - 1);
  };
  copy(coc);
  copy(brightest);
  std::for_each(pinhole.begin(), pinhole.end(), copy);
  std::for_each(result.begin(), result.end(), copy);
}

void Strip::load_row(int y, int j) {
  const std::size_t first = size(y) * size(width_);
  const auto load = [&](StripRows& rows, const auto& value_at) {
    float* const row = rows.row(j);
    for (int x = 0; x < width_; ++x) row[x] = value_at(first + size(x));
    extend(row, width_);
  };
  load(coc,
       [&](std::size_t i) { return static_cast<float>(tame(coc_quanta_[i])) * px_per_quantum; });
  load(brightest, [&](std::size_t i) {
    float most = 0;
    for (const auto& light : result_light_) most = light[i] > most ? light[i] : most;
    return most;
  });
  const ShownTable& table = shown_table();
  for (std::size_t c = 0; c < channels(); ++c) {
    load(pinhole[c], [&](std::size_t i) { return table(pinhole_light_[c][i]); });
    load(result[c], [&](std::size_t i) { return table(result_light_[c][i]); });
  }
}

// In these loops nothing else lies where they write: compilers make vectors of them.

void find_gradient(const std::vector<StripRows>& shown, int j, Plane& out) {
  std::fill(out.begin(), out.end(), 0.0f);
  const float share = 0.25f / static_cast<float>(shown.size());
  float* const __restrict to = out.data();
  for (const StripRows& channel : shown) {
    const float *above = channel.row(j - 1), *row = channel.row(j), *below = channel.row(j + 1);
    const float* const left = row - 1;
    for (std::size_t x = 0, width = out.size(); x < width; ++x) {
      const float dx = row[x + 1] - left[x], dy = below[x] - above[x];
      to[x] += (dx * dx + dy * dy) * share;
    }
  }
}

void find_grain(const std::vector<StripRows>& shown, int j, Plane& out) {
  std::fill(out.begin(), out.end(), 0.0f);
  const float share = 1 / static_cast<float>(shown.size());
  Plane columns(out.size() + 2);
  float* const __restrict to = out.data(), * const __restrict sums = columns.data();
  for (const StripRows& channel : shown) {
    const float *above = channel.row(j - 1) - 1, *row = channel.row(j) - 1;
    const float* const below = channel.row(j + 1) - 1;
    for (std::size_t x = 0, width = columns.size(); x < width; ++x) {
      sums[x] = above[x] + row[x] + below[x];
    }
    for (std::size_t x = 0, width = out.size(); x < width; ++x) {
      const float off = (sums[x] + sums[x + 1] + sums[x + 2]) / 9 - row[x + 1];
      to[x] += off * off * share;
    }
  }
}

namespace {

/// Joins 3x3 values by `join`, row by row.
template <typename Join>
void join_around(const StripRows& values, int j, Plane& out, const Join& join) {
  const float *above = values.row(j - 1) - 1, *row = values.row(j) - 1;
  const float* const below = values.row(j + 1) - 1;
  Plane columns(out.size() + 2);
  float* const __restrict to = out.data(), * const __restrict joined = columns.data();
  for (std::size_t x = 0, width = columns.size(); x < width; ++x) {
    joined[x] = join(join(above[x], row[x]), below[x]);
  }
  for (std::size_t x = 0, width = out.size(); x < width; ++x) {
    to[x] = join(join(joined[x], joined[x + 1]), joined[x + 2]);
  }
}

constexpr auto larger = [](float a, float b) { return a > b ? a : b; };
constexpr auto smaller = [](float a, float b) { return a < b ? a : b; };

}  // namespace

void find_range(const StripRows& values, int j, Plane& out) {
  Plane least(out.size());
  join_around(values, j, out, larger);
  join_around(values, j, least, smaller);
  float* const __restrict to = out.data();
  for (std::size_t x = 0, width = out.size(); x < width; ++x) to[x] -= least[x];
}

void find_largest(const StripRows& values, int j, Plane& out) {
  join_around(values, j, out, larger);
}

}  // namespace defray
