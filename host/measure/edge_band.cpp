#include "measure/edge_band.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "base/error.h"
#include "lens/coc.h"

namespace defray {
namespace {

bool is_discontinuity(float a, float b, double step) {
  return static_cast<double>(std::max(a, b)) > (1 + step) * static_cast<double>(std::min(a, b));
}

/// At each pixel of a discontinuity the reach of its blur in pixels, 0 elsewhere.
std::vector<double> reaches(const Plane& depth, int width, std::span<const std::int32_t> coc_quanta,
                            double step) {
  std::vector<double> reach(depth.size());
  const auto visit = [&](std::size_t p, std::size_t q) {
    if (!is_discontinuity(depth[p], depth[q], step)) return;
    const int radius = std::max(std::abs(coc_quanta[p]), std::abs(coc_quanta[q]));
    const double both = std::ldexp(radius, -DEFRAY_COC_FRACTION_BITS) + 1;
    reach[p] = std::max(reach[p], both);
    reach[q] = std::max(reach[q], both);
  };
  const auto row = static_cast<std::size_t>(width);
  for (std::size_t i = 0; i < depth.size(); ++i) {
    if (i % row + 1 < row) visit(i, i + 1);
    if (i + row < depth.size()) visit(i, i + row);
  }
  return reach;
}

/// Discs drawn as spans of rows: +1 where one begins, -1 behind its end. Sums along the rows then
/// count the discs over each pixel, at a cost that grows with a disc's rows and not with its area.
class Discs {
 public:
  Discs(int width, int height) : width_(width), height_(height), change_(index(0, height)) {}

  void add(int x, int y, double radius) {
    const double rows = std::min(radius, static_cast<double>(height_));
    const int top = std::max(0, y - static_cast<int>(rows));
    const int bottom = std::min(height_ - 1, y + static_cast<int>(rows));
    for (int at = top; at <= bottom; ++at) {
      const double half = std::sqrt(radius * radius - (at - y) * (at - y));
      const int reach = static_cast<int>(std::min(half, static_cast<double>(width_)));
      ++change_[index(std::max(0, x - reach), at)];
      --change_[index(std::min(width_, x + reach + 1), at)];
    }
  }

  std::vector<std::uint8_t> covered() const {
    std::vector<std::uint8_t> mask;
    for (int y = 0; y < height_; ++y) {
      std::int32_t discs = 0;
      for (int x = 0; x < width_; ++x) mask.push_back((discs += change_[index(x, y)]) > 0);
    }
    return mask;
  }

 private:
  /// One column more than the frame, for ends of spans.
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_ + 1) +
           static_cast<std::size_t>(x);
  }

  int width_, height_;
  std::vector<std::int32_t> change_;
};

}  // namespace

std::vector<std::uint8_t> edge_band(const Plane& depth, int width,
                                    std::span<const std::int32_t> coc_quanta, double step) {
  if (!(step >= 0) || !std::isfinite(step)) {
    fail(ErrorKind::usage, "{} is {}: it must be a finite number, 0 or more", field("edge_step"),
         step);
  }
  const std::vector<double> reach = reaches(depth, width, coc_quanta, step);
  const auto row = static_cast<std::size_t>(width);
  Discs discs(width, static_cast<int>(depth.size() / row));
  for (std::size_t i = 0; i < depth.size(); ++i) {
    if (reach[i] > 0) discs.add(static_cast<int>(i % row), static_cast<int>(i / row), reach[i]);
  }
  return discs.covered();
}

}  // namespace defray
