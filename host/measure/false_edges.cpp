#include "measure/false_edges.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>

#include "base/parallel.h"
#include "base/srgb.h"
#include "measure/metrics.h"

namespace defray {
namespace {

using Luma = cv::Mat_<double>;

constexpr int truth_within_px = 2;

Luma luma(const std::vector<Plane>& picture, int width) {
  Luma out(static_cast<int>(picture[0].size()) / width, width);
  double* const to = out[0];
  parallel_for_each(picture[0].size(), [&](std::size_t i) {
    to[i] = 255 * (0.2126 * shown_value(picture[0][i]) + 0.7152 * shown_value(picture[1][i]) +
                   0.0722 * shown_value(picture[2][i]));
  });
  return out;
}

Luma gradient(const Luma& from) {
  Luma out(from.size());
  const auto slope = [](double before, double after, int apart) {
    return apart == 0 ? 0 : (after - before) / apart;
  };
  parallel_for(from.rows, [&](int y) {
    const int above = std::max(y - 1, 0), below = std::min(y + 1, from.rows - 1);
    for (int x = 0; x < from.cols; ++x) {
      const int left = std::max(x - 1, 0), right = std::min(x + 1, from.cols - 1);
      const double across = slope(from(y, left), from(y, right), right - left);
      const double down = slope(from(above, x), from(below, x), below - above);
      out(y, x) = std::sqrt(across * across + down * down);
    }
  });
  return out;
}

/// The smallest value that a thousandth of them at most exceeds.
double percentile_999(std::vector<double> values) {
  const std::size_t above = values.size() / 1000;
  const auto at = values.end() - 1 - static_cast<std::ptrdiff_t>(above);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

Excess excess_of(const Luma& found, const Luma& in_truth) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  if (!cv::checkRange(found) || !cv::checkRange(in_truth)) return {nan, nan, nan};
  Luma allowed;
  constexpr int side = 2 * truth_within_px + 1;
  cv::dilate(in_truth, allowed, cv::Mat::ones(side, side, CV_8U));
  Luma above;
  cv::max(found - allowed, 0, above);
  Excess out;
  cv::Point worst;
  cv::minMaxLoc(above, nullptr, &out.worst, nullptr, &worst);
  out.worst_x = worst.x;
  out.worst_y = worst.y;
  out.rms = std::sqrt(above.dot(above) / static_cast<double>(above.total()));
  out.p999 = percentile_999({above.begin(), above.end()});
  return out;
}

}  // namespace

Excess false_edges(const std::vector<Plane>& result, const std::vector<Plane>& truth, int width) {
  require_same_size(result, truth);
  return excess_of(gradient(luma(result, width)), gradient(luma(truth, width)));
}

Excess false_changes(const std::vector<Plane>& result, const std::vector<Plane>& next_result,
                     const std::vector<Plane>& truth, const std::vector<Plane>& next_truth,
                     int width) {
  for (const auto* picture : {&next_result, &truth, &next_truth}) {
    require_same_size(result, *picture);
  }
  const auto change = [&](const std::vector<Plane>& from, const std::vector<Plane>& to) {
    Luma out;
    cv::absdiff(luma(to, width), luma(from, width), out);
    return out;
  };
  return excess_of(change(result, next_result), change(truth, next_truth));
}

}  // namespace defray
