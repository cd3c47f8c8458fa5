#include "splat/surfels/spread.h"

#include <opencv2/core.hpp>

#include "base/plane.h"

namespace defray {

Spread spread_of(std::span<const Vec3> places) {
  Vec3 mean{};
  for (const Vec3& place : places) mean = mean + place;
  mean = mean / static_cast<double>(places.size());
  cv::Matx33d covariance = cv::Matx33d::zeros();
  for (const Vec3& place : places) {
    const Vec3 d = place - mean;
    const cv::Vec3d v(d.x, d.y, d.z);
    covariance += v * v.t();
  }
  cv::Vec3d values;
  cv::Matx33d vectors;
  cv::eigen(covariance, values, vectors);
  Spread spread{.mean = mean, .variances = {}, .axes = {}};
  for (int k = 0; k < 3; ++k) {
    spread.variances[size(k)] = values[k];
    spread.axes[size(k)] = {vectors(k, 0), vectors(k, 1), vectors(k, 2)};
  }
  return spread;
}

}  // namespace defray
