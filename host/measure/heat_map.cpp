#include "measure/heat_map.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "base/error.h"
#include "image/ldr.h"
#include "image/safe_output.h"

namespace defray {
namespace {

constexpr int cell_width = 76, cell_height = 40;
constexpr int map_left = 70, map_top = 84, map_margin = 20;
constexpr double label_scale = 0.45;
constexpr int label_font = cv::FONT_HERSHEY_SIMPLEX;

void put_in_middle(cv::Mat& image, const std::string& text, cv::Point middle,
                   const cv::Scalar& colour, double scale = label_scale) {
  const cv::Size size = cv::getTextSize(text, label_font, scale, 1, nullptr);
  cv::putText(image, text, {middle.x - size.width / 2, middle.y + size.height / 2}, label_font,
              scale, colour, 1, cv::LINE_AA);
}

/// Viridis, light where `share` is 0: as far above the smallest value as the largest is at 1.
cv::Scalar heat_colour(double share) {
  const cv::Mat level(1, 1, CV_8U, cv::Scalar(std::round(255 * (1 - share))));
  cv::Mat colour;
  cv::applyColorMap(level, colour, cv::COLORMAP_VIRIDIS);
  const auto c = colour.at<cv::Vec3b>(0, 0);
  return {double(c[0]), double(c[1]), double(c[2])};
}

void check_map(const HeatMap& map) {
  if (map.values.size() != map.columns.size() * map.rows.size()) {
    fail(ErrorKind::usage, "{}: {} values for {} cells", map.title, map.values.size(),
         map.columns.size() * map.rows.size());
  }
  bool has_any = false;
  for (const auto& v : map.values) {
    if (v && !(std::isfinite(*v) && *v > 0)) {
      fail(ErrorKind::usage, "{}: a value is {}: it must be above 0", map.title, *v);
    }
    has_any |= v.has_value();
  }
  if (!has_any) fail(ErrorKind::usage, "{}: nothing was measured", map.title);
}

cv::Mat drawn(const HeatMap& map) {
  const cv::Scalar dark(0, 0, 0), light = cv::Scalar::all(255);
  const int columns = static_cast<int>(map.columns.size());
  const int rows = static_cast<int>(map.rows.size());
  cv::Mat image(map_top + rows * cell_height + 40, map_left + columns * cell_width + map_margin,
                CV_8UC3, light);
  double least = HUGE_VAL, most = 0;
  for (const auto& v : map.values) {
    if (!v) continue;
    least = std::min(least, *v);
    most = std::max(most, *v);
  }
  put_in_middle(image, map.title, {image.cols / 2, 24}, dark, 0.6);
  put_in_middle(image, map.y_label, {map_left / 2, map_top - 14}, dark);
  put_in_middle(image, map.x_label, {map_left + columns * cell_width / 2, image.rows - 14}, dark);
  for (int y = 0; y < rows; ++y) {
    const int middle_y = map_top + y * cell_height + cell_height / 2;
    put_in_middle(image, map.rows[static_cast<std::size_t>(y)], {map_left / 2, middle_y}, dark);
    for (int x = 0; x < columns; ++x) {
      const cv::Rect cell(map_left + x * cell_width, map_top + y * cell_height, cell_width,
                          cell_height);
      const auto& v = map.values[static_cast<std::size_t>(y * columns + x)];
      if (!v) continue;
      const double share = most > least ? std::log(*v / least) / std::log(most / least) : 0;
      cv::rectangle(image, cell, heat_colour(share), cv::FILLED);
      put_in_middle(image, fmt::format("{:.3g}", *v), {cell.x + cell_width / 2, middle_y},
                    share < 0.5 ? dark : light);
      if (*v == least) cv::rectangle(image, cell, cv::Scalar(0, 0, 220), 3);
    }
  }
  for (int x = 0; x < columns; ++x) {
    put_in_middle(image, map.columns[static_cast<std::size_t>(x)],
                  {map_left + x * cell_width + cell_width / 2, map_top - 14}, dark);
  }
  return image;
}

}  // namespace

void write_heat_map(const std::string& path, const HeatMap& map) {
  check_map(map);
  if (!is_ldr_path(path)) fail(ErrorKind::usage, "{}: a heat map is PNG or JPEG", path);
  const cv::Mat image = drawn(map);
  write_safely(path, [&](const std::string& name) { write_encoded(name, &image); });
}

}  // namespace defray
