// How much the known colours around what is hidden vary.
#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "base/vectorised.h"
#include "chain/patterns.h"

namespace defray {
namespace {

/// Two sums in a word: how many pixels and their squares (params.h), and two of colours, below
/// 255 x 2^22.4 < 2^32.
constexpr std::uint64_t one = std::uint64_t{1} << DEFRAY_PATTERN_COUNT_BIT;
constexpr std::uint64_t low_word = 0xffffffffu;

std::uint64_t squared(std::uint64_t v) { return v * v; }

/// Adds what is known of a row of pixels, a column each, or takes it away.
DEFRAY_VECTORISED void add_known(const std::uint32_t* row, std::size_t width, bool is_taken_away,
                                 std::uint64_t* squares, std::uint64_t* red_green,
                                 std::uint64_t* blue) {
  const std::uint64_t sign = is_taken_away ? ~std::uint64_t{0} : 0;
  for (std::size_t x = 0; x < width; ++x) {
    const std::uint32_t v = row[x];
    const std::uint64_t known = std::uint64_t{0} - (v & DEFRAY_PATTERN_KNOWN ? 1 : 0);
    const std::uint32_t r = v & 255, g = v >> 8 & 255, b = v >> 16 & 255;
    squares[x] += (((one + r * r + g * g + b * b) & known) ^ sign) - sign;
    red_green[x] += (((r | std::uint64_t{g} << 32) & known) ^ sign) - sign;
    blue[x] += ((b & known) ^ sign) - sign;
  }
}

DEFRAY_VECTORISED void add_to(std::uint64_t* sum, const std::uint64_t* more,
                              const std::uint64_t* less, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) sum[i] += more[i] - less[i];
}

/// Three sums a column, with as many columns of zeros on both sides as a window reaches.
class Lines {
 public:
  Lines(int width, int n)
      : width_(size(width)),
        margin_(size(n) + 1),
        stride_(width_ + 2 * margin_),
        all_(3 * stride_) {}

  void add(const std::uint32_t* row, bool is_taken_away = false) {
    if (row) add_known(row, width_, is_taken_away, from(0, 0), from(1, 0), from(2, 0));
  }
  void add(const Lines& more, const Lines& less) {
    add_to(all_.data(), more.all_.data(), less.all_.data(), all_.size());
  }
  std::uint64_t at(int i, int x) const { return from(i, 0)[x]; }

 private:
  std::uint64_t* from(int i, int x) { return &all_[size(i) * stride_ + margin_ + size(x)]; }
  const std::uint64_t* from(int i, int x) const {
    return &all_[size(i) * stride_ + margin_ + size(x)];
  }
  std::size_t width_, margin_, stride_;
  std::vector<std::uint64_t> all_;
};

/// Sums with weights n - |j| over columns, row after row.
class ColumnSums {
 public:
  ColumnSums(int width, int height, int n, std::span<const std::uint32_t> words, int y)
      : sums(width, n),
        before_(width, n),
        after_(width, n),
        none_(width, n),
        width_(width),
        height_(height),
        n_(n),
        words_(words),
        y_(y) {
    for (int j = 0; j < n; ++j) {
      before_.add(row(y - j));
      sums.add(before_, none_);
    }
    for (int j = 1; j < n; ++j) {
      after_.add(row(y + j));
      sums.add(after_, none_);
    }
    after_.add(row(y + n));
  }

  /// sum(y + 1) = sum(y) + values y + 1 ... y + n - values y - n + 1 ... y.
  void move_down() {
    sums.add(after_, before_);
    ++y_;
    after_.add(row(y_ + n_));
    after_.add(row(y_), true);
    before_.add(row(y_));
    before_.add(row(y_ - n_), true);
  }

  Lines sums;

 private:
  const std::uint32_t* row(int y) const {
    return y < 0 || y >= height_ ? nullptr : &words_[size(y) * size(width_)];
  }
  Lines before_, after_, none_;
  int width_, height_, n_;
  std::span<const std::uint32_t> words_;
  int y_;
};

/// The same along a row of them.
class RowSum {
 public:
  RowSum(const Lines& lines, int i, int n, int x) : lines_(lines), i_(i), n_(n), x_(x) {
    for (int j = 0; j < n; ++j) sum_ += before_ += at(x - j);
    for (int j = 1; j < n; ++j) sum_ += after_ += at(x + j);
    after_ += at(x + n);
  }
  std::uint64_t sum() const { return sum_; }
  void move_on() {
    sum_ += after_ - before_;
    ++x_;
    after_ += at(x_ + n_) - at(x_);
    before_ += at(x_) - at(x_ - n_);
  }

 private:
  std::uint64_t at(int x) const { return lines_.at(i_, x); }
  const Lines& lines_;
  int i_, n_, x_;
  std::uint64_t sum_ = 0, before_ = 0, after_ = 0;
};

/// n sum(v^2) - sum(v)^2 over n^2; the first, below 2^62.4, is exact, and never negative.
float variance_of(std::uint64_t squares, std::uint64_t red_green, std::uint64_t blue) {
  const std::uint64_t count = squares >> DEFRAY_PATTERN_COUNT_BIT;
  if (count == 0) return 0;
  const std::uint64_t scaled = count * (squares & (one - 1)) - squared(red_green & low_word) -
                               squared(red_green >> 32) - squared(blue);
  const auto known = static_cast<double>(count);
  return static_cast<float>(static_cast<double>(scaled) / (known * known));
}

bool is_behind(std::uint32_t word) { return (word & DEFRAY_PATTERN_BEHIND) != 0; }

/// Of a row's hidden pixels.
void row_variance(const Lines& columns, int n, std::span<const std::uint32_t> words,
                  std::span<float> out) {
  const auto first = std::find_if(words.begin(), words.end(), is_behind);
  const auto end = std::find_if(words.rbegin(), words.rend(), is_behind).base();
  if (first == words.end()) return;
  const int begin = static_cast<int>(first - words.begin());
  RowSum squares(columns, 0, n, begin), red_green(columns, 1, n, begin), blue(columns, 2, n, begin);
  for (std::size_t x = size(begin); x < size(static_cast<int>(end - words.begin())); ++x) {
    if (is_behind(words[x])) out[x] = variance_of(squares.sum(), red_green.sum(), blue.sum());
    squares.move_on();
    red_green.move_on();
    blue.move_on();
  }
}

}  // namespace

Plane patterns_variance(const Frame& frame, const Words& pixels, const PatternSettings& settings) {
  constexpr int band = 128;
  Plane variance(pixels.size());
  const auto words = pixels.host();
  parallel_for((frame.height + band - 1) / band, [&](int i) {
    const int first = i * band, end = std::min(first + band, frame.height);
    const auto rows =
        words.subspan(size(first) * size(frame.width), size(end - first) * size(frame.width));
    if (std::none_of(rows.begin(), rows.end(), is_behind)) return;
    ColumnSums columns(frame.width, frame.height, settings.window_px, words, first);
    for (int y = first; y < end; ++y) {
      const std::size_t row = size(y) * size(frame.width);
      row_variance(columns.sums, settings.window_px, words.subspan(row, size(frame.width)),
                   std::span(variance).subspan(row, size(frame.width)));
      columns.move_down();
    }
  });
  return variance;
}

}  // namespace defray
