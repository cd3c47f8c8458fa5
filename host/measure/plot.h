#pragma once
// Line and scatter charts as pictures. OpenCV draws them.
#include <array>
#include <string>
#include <vector>

namespace defray {

/// A point of a chart, in the units of its axes. `label`: ASCII text beside it; empty: none.
struct PlotPoint {
  double x = 0, y = 0;
  std::string label = {};
};

/// Points of one colour and marker. `name` (ASCII) goes into the legend; empty: not listed there.
struct Series {
  std::string name;
  std::vector<PlotPoint> points;
  bool lines = true;    ///< Joined in the order given.
  bool markers = true;  ///< A dot, square, diamond or triangle at each point.
};

/// A chart. Axes span the data, out to the next tick. Texts are ASCII.
struct Plot {
  std::string title, x_label, y_label;
  bool x_log = false, y_log = false;  ///< log10 axes: positive values only.
  std::vector<Series> series = {};
};

constexpr int plot_width_px = 1000, plot_height_px = 640;

/// Where write_plot draws a point: pixels from the picture's left and top edge.
/// Throws Error(usage) as write_plot does.
std::array<double, 2> plot_position(const Plot& plot, const PlotPoint& point);

/// Draws the chart to a PNG or JPEG. Throws Error(usage) when there is no point to draw, a value is
/// not finite, or not positive on a log axis; Error(output) when `path` cannot be written.
void write_plot(const std::string& path, const Plot& plot);

}  // namespace defray
