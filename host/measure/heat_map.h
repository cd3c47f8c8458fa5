#pragma once
// Figures over a grid, as a picture: the smaller, the lighter.
#include <optional>
#include <string>
#include <vector>

namespace defray {

/// Texts are ASCII. `values`: a row after the other, positive; empty: not measured.
struct HeatMap {
  std::string title, x_label, y_label;
  std::vector<std::string> columns, rows;
  std::vector<std::optional<double>> values;
};

/// Draws it to a PNG or JPEG, the smallest value framed. Throws Error(usage) where nothing was
/// measured, a value is not finite and positive, or their number is not that of the cells;
/// Error(output) when `path` cannot be written.
void write_heat_map(const std::string& path, const HeatMap& map);

}  // namespace defray
