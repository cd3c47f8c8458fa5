#include "splat/cloud_points.h"

#include <algorithm>
#include <numbers>
#include <opencv2/core.hpp>

namespace defray {
namespace {

/// The nearest of a square grid's point, and their mean distance in sides of its squares.
constexpr std::size_t close_count = 8;
constexpr double close_distance = (4 + 4 * std::numbers::sqrt2) / 8;

}  // namespace

Vec3 estimated_normal(const CloudPoints& cloud, std::size_t point) {
  const auto around = cloud.around.of(point);
  Vec3 mean = cloud.place(point);
  for (const std::uint32_t i : around) mean = mean + cloud.place(i);
  mean = mean / static_cast<double>(around.size() + 1);
  cv::Matx33d covariance = cv::Matx33d::zeros();
  const auto add = [&](std::size_t i) {
    const Vec3 d = cloud.place(i) - mean;
    const cv::Vec3d v(d.x, d.y, d.z);
    covariance += v * v.t();
  };
  add(point);
  for (const std::uint32_t i : around) add(i);
  cv::Vec3d values;
  cv::Matx33d vectors;
  cv::eigen(covariance, values, vectors);  // the largest first
  if (values[1] > 1e-12 * values[0]) return {vectors(2, 0), vectors(2, 1), vectors(2, 2)};
  // Along a line, or alone: any direction across will do.
  const Vec3 line = values[0] > 0 ? Vec3{vectors(0, 0), vectors(0, 1), vectors(0, 2)} : Vec3{};
  const Vec3 towards = std::abs(line.z) < 0.9 ? Vec3{0, 0, 1} : Vec3{0, 1, 0};
  return normalized(towards - line * dot(line, towards));
}

double spacing_of(const CloudPoints& cloud, std::size_t point) {
  double sum = 0;
  std::size_t count = 0;
  for (const std::uint32_t i : cloud.around.of(point)) {
    const double distance = length(cloud.place(i) - cloud.place(point));
    if (!(distance > 0)) continue;
    sum += distance;
    if (++count == close_count) break;
  }
  return count > 0 ? sum / static_cast<double>(count) / close_distance : 0;
}

}  // namespace defray
