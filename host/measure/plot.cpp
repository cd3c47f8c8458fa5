#include "measure/plot.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "base/error.h"
#include "image/ldr.h"
#include "image/safe_output.h"
#include "measure/plot_axis.h"

namespace defray {
namespace {

constexpr int font = cv::FONT_HERSHEY_SIMPLEX;
constexpr double text_scale = 0.5;
constexpr int fraction_bits = 4;  // OpenCV's sub-pixel positions
constexpr int marker_radius = 5;

const cv::Scalar black(0, 0, 0), grey(225, 225, 225);

/// Okabe & Ito 2008, distinguishable with every kind of colour vision, without yellow. B G R.
const std::vector<cv::Scalar> colours = {{178, 114, 0},   {0, 94, 213},  {115, 158, 0},
                                         {167, 121, 204}, {0, 159, 230}, {233, 180, 86},
                                         {0, 0, 0}};

cv::Size text_size(const std::string& text, double scale = text_scale) {
  return cv::getTextSize(text, font, scale, 1, nullptr);
}

/// The scale, `most` or less, at which a text fits.
double fitting_scale(const std::string& text, double most, int width) {
  const int wide = text_size(text, most).width;
  return wide > width ? most * width / wide : most;
}

void put_text(cv::Mat& image, const std::string& text, cv::Point left_bottom,
              double scale = text_scale) {
  cv::putText(image, text, left_bottom, font, scale, black, 1, cv::LINE_AA);
}

std::vector<double> values(const Plot& plot, double PlotPoint::*coordinate) {
  std::vector<double> all;
  for (const Series& series : plot.series) {
    for (const PlotPoint& point : series.points) all.push_back(point.*coordinate);
  }
  return all;
}

/// Left of the axes: the y axis's text and its tick labels.
int left_margin(const Axis& y) {
  int width = 0;
  for (const double tick : y.ticks()) width = std::max(width, text_size(y.label(tick)).width);
  return 46 + width;
}

int legend_width(const Plot& plot) {
  int width = 0;
  for (const Series& s : plot.series) {
    if (!s.name.empty()) width = std::max(width, text_size(s.name).width + 50);
  }
  return std::min(width, 320);
}

/// A chart in the making.
class Chart {
 public:
  explicit Chart(const Plot& plot)
      : plot_(plot),
        x_(plot.x_label, values(plot, &PlotPoint::x), plot.x_log),
        y_(plot.y_label, values(plot, &PlotPoint::y), plot.y_log),
        area_(cv::Point(left_margin(y_), 56),
              cv::Point(plot_width_px - 30 - legend_width(plot), plot_height_px - 70)) {}

  cv::Point2d position(const PlotPoint& point) const {
    return {area_.x + x_.share(point.x) * area_.width,
            area_.y + (1 - y_.share(point.y)) * area_.height};
  }

  cv::Mat draw() {
    draw_axes();
    draw_texts();
    for (std::size_t i = 0; i < plot_.series.size(); ++i) draw_series(i);
    for (const Series& series : plot_.series) {
      for (const PlotPoint& point : series.points) draw_label(point);
    }
    draw_legend();
    return image_;
  }

 private:
  void draw_axes();
  void draw_texts();
  void draw_legend();
  void draw_series(std::size_t index);
  int ink(const cv::Rect& place) const;
  void draw_label(const PlotPoint& point);
  void draw_line(cv::Point2d from, cv::Point2d to, const cv::Scalar& colour, int thickness);
  void draw_marker(std::size_t series, cv::Point2d at);

  const Plot& plot_;
  Axis x_, y_;
  cv::Rect area_;
  cv::Mat image_{plot_height_px, plot_width_px, CV_8UC3, cv::Scalar::all(255)};
};

cv::Point fixed_point(cv::Point2d p) {
  return {static_cast<int>(std::lround(p.x * (1 << fraction_bits))),
          static_cast<int>(std::lround(p.y * (1 << fraction_bits)))};
}

const cv::Scalar& colour_of(std::size_t series) { return colours[series % colours.size()]; }

void Chart::draw_line(cv::Point2d from, cv::Point2d to, const cv::Scalar& colour, int thickness) {
  cv::line(image_, fixed_point(from), fixed_point(to), colour, thickness, cv::LINE_AA,
           fraction_bits);
}

void Chart::draw_axes() {
  for (const double tick : x_.ticks()) {
    const double x = area_.x + x_.share(tick) * area_.width;
    draw_line({x, double(area_.y)}, {x, double(area_.br().y)}, grey, 1);
    const std::string label = x_.label(tick);
    put_text(image_, label, cv::Point2d(x - text_size(label).width / 2.0, area_.br().y + 20));
  }
  for (const double tick : y_.ticks()) {
    const double y = area_.y + (1 - y_.share(tick)) * area_.height;
    draw_line({double(area_.x), y}, {double(area_.br().x), y}, grey, 1);
    const std::string label = y_.label(tick);
    put_text(image_, label, cv::Point2d(area_.x - 8 - text_size(label).width, y + 5));
  }
  cv::rectangle(image_, area_.tl(), area_.br(), black);
}

void Chart::draw_texts() {
  const double title_scale = fitting_scale(plot_.title, 0.75, plot_width_px - 40);
  put_text(image_, plot_.title,
           {(plot_width_px - text_size(plot_.title, title_scale).width) / 2, 34}, title_scale);
  const double x_scale = fitting_scale(plot_.x_label, 0.55, area_.width);
  const int x_width = text_size(plot_.x_label, x_scale).width;
  put_text(image_, plot_.x_label, {area_.x + (area_.width - x_width) / 2, area_.br().y + 50},
           x_scale);
  // The y axis's text is written on a strip, which is then turned upright.
  cv::Mat strip(26, area_.height, CV_8UC3, cv::Scalar::all(255)), upright;
  const double y_scale = fitting_scale(plot_.y_label, 0.55, area_.height);
  put_text(strip, plot_.y_label, {(area_.height - text_size(plot_.y_label, y_scale).width) / 2, 18},
           y_scale);
  cv::rotate(strip, upright, cv::ROTATE_90_COUNTERCLOCKWISE);
  upright.copyTo(image_(cv::Rect({6, area_.y}, upright.size())));
}

void Chart::draw_marker(std::size_t series, cv::Point2d at) {
  constexpr double r = marker_radius;
  const std::vector<std::vector<cv::Point2d>> shapes = {
      {{-r, -r}, {r, -r}, {r, r}, {-r, r}},
      {{0, -1.3 * r}, {1.3 * r, 0}, {0, 1.3 * r}, {-1.3 * r, 0}},
      {{0, -1.2 * r}, {1.2 * r, r}, {-1.2 * r, r}}};
  const std::size_t shape = series % (shapes.size() + 1);
  if (shape == 0) {
    cv::circle(image_, fixed_point(at), marker_radius << fraction_bits, colour_of(series),
               cv::FILLED, cv::LINE_AA, fraction_bits);
    return;
  }
  std::vector<cv::Point> corners;
  for (const cv::Point2d& corner : shapes[shape - 1]) corners.push_back(fixed_point(at + corner));
  cv::fillConvexPoly(image_, corners, colour_of(series), cv::LINE_AA, fraction_bits);
}

void Chart::draw_series(std::size_t index) {
  const Series& series = plot_.series[index];
  for (std::size_t i = 0; i < series.points.size(); ++i) {
    const cv::Point2d at = position(series.points[i]);
    if (series.lines && i > 0) {
      draw_line(position(series.points[i - 1]), at, colour_of(index), 2);
    }
    if (series.markers) draw_marker(index, at);
  }
}

/// How much of a rectangle is drawn on already, the grid aside; all of it outside the axes.
int Chart::ink(const cv::Rect& place) const {
  if ((place & area_) != place) return place.area();
  cv::Mat free;
  cv::inRange(image_(place), grey, cv::Scalar::all(255), free);
  return place.area() - cv::countNonZero(free);
}

/// At that corner of the point where it covers least, or above or below that.
void Chart::draw_label(const PlotPoint& point) {
  if (point.label.empty()) return;
  const double scale = 0.45;
  const cv::Size size = text_size(point.label, scale);
  const cv::Point at = position(point);
  const int right = at.x + 8, left = at.x - 8 - size.width;
  const int above = at.y - 6 - size.height, below = at.y + 6;
  std::vector<cv::Rect> places;
  for (int off = 0; off < 3 * (size.height + 4); off += size.height + 4) {
    for (const int y : {above - off, below + off}) {
      for (const int x : {right, left}) places.push_back({{x, y}, size});
    }
  }
  const cv::Rect place =
      *std::min_element(places.begin(), places.end(),
                        [this](const cv::Rect& a, const cv::Rect& b) { return ink(a) < ink(b); });
  put_text(image_, point.label, {place.x, place.y + size.height}, scale);
}

void Chart::draw_legend() {
  const int left = area_.br().x + 16;
  int y = area_.y + 12;
  for (std::size_t i = 0; i < plot_.series.size(); ++i) {
    const Series& series = plot_.series[i];
    if (series.name.empty()) continue;
    if (series.lines)
      draw_line({double(left), double(y)}, {left + 24.0, double(y)}, colour_of(i), 2);
    if (series.markers) draw_marker(i, {left + 12.0, double(y)});
    put_text(image_, series.name, {left + 32, y + 5}, fitting_scale(series.name, text_scale, 270));
    y += 24;
  }
}

}  // namespace

std::array<double, 2> plot_position(const Plot& plot, const PlotPoint& point) {
  const cv::Point2d at = Chart(plot).position(point);
  return {at.x, at.y};
}

void write_plot(const std::string& path, const Plot& plot) {
  if (!is_ldr_path(path)) fail(ErrorKind::usage, "{}: a chart is PNG or JPEG", path);
  const cv::Mat image = Chart(plot).draw();
  write_safely(path, [&](const std::string& name) { write_encoded(name, &image); });
}

}  // namespace defray
