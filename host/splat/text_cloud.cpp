// Clouds as text: a point a line, numbers with spaces, commas, semicolons or tabs between them;
// lines that begin with # or // are comments; a first line of names says what the columns are.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <istream>
#include <optional>

#include "base/error.h"
#include "base/text.h"
#include "splat/cloud_columns.h"

namespace defray {
namespace {

using Columns = std::vector<std::string>;

Columns columns_in(const std::string& line) {
  Columns words;
  std::string word;
  for (const char c : line + ' ') {
    const bool parts = c == ' ' || c == ',' || c == ';' || c == '\t' || c == '\r' || c == '"';
    if (!parts) word.push_back(c);
    if (parts && !word.empty()) words.push_back(std::exchange(word, {}));
  }
  return words;
}

std::optional<double> number(const std::string& word) {
  char* end = nullptr;
  const double value = std::strtod(word.c_str(), &end);
  if (*end != '\0' || word.empty()) return std::nullopt;
  return value;
}

std::optional<std::vector<double>> numbers(const Columns& words) {
  std::vector<double> row;
  for (const std::string& word : words) {
    const auto value = number(word);
    if (!value) return std::nullopt;
    row.push_back(*value);
  }
  return row;
}

bool is_comment(const std::string& line) { return line.starts_with("#") || line.starts_with("//"); }

/// What unnamed columns are, by their number and the first row.
Columns names_for(const std::vector<double>& row, const std::string& path) {
  const auto are_colours = [&](std::size_t first) {
    return std::all_of(row.begin() + static_cast<std::ptrdiff_t>(first),
                       row.begin() + static_cast<std::ptrdiff_t>(first + 3),
                       [](double v) { return v >= 0 && v <= 255 && v == std::floor(v); });
  };
  const Columns place{"x", "y", "z"}, normal{"nx", "ny", "nz"}, colour{"red", "green", "blue"};
  Columns names = place;
  const auto append = [&](const Columns& more) {
    names.insert(names.end(), more.begin(), more.end());
  };
  if (row.size() == 6) append(are_colours(3) ? colour : normal);
  if (row.size() == 9) {
    append(are_colours(3) && !are_colours(6) ? colour : normal);
    append(names.back() == "blue" ? normal : colour);
  }
  if (names.size() != row.size()) {
    fail(ErrorKind::input,
         "{}: has {} columns: without a line of names (x y z nx ny nz red green blue alpha radius) "
         "3, 6 or 9 are understood",
         path, row.size());
  }
  return names;
}

/// Colours up to 255 if the first point's are whole numbers above 1, or all 0 or 1 as of 8 bits.
CloudColumns columns_of(const Columns& names, const std::vector<double>& row,
                        const std::string& path) {
  std::vector<double> whole(names.size(), 0);
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string name = lower_case(names[i]);
    const bool is_colour = name == "red" || name == "green" || name == "blue" || name == "alpha" ||
                           name == "r" || name == "g" || name == "b" || name == "a";
    if (is_colour) whole[i] = 255;
  }
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (whole[i] > 0 && row[i] != std::floor(row[i])) std::fill(whole.begin(), whole.end(), 0);
  }
  return {names, whole, path};
}

}  // namespace

PointCloud read_text_cloud(std::istream& file, std::uint64_t bytes, const std::string& path) {
  Columns names;
  std::optional<CloudColumns> columns;
  std::uint64_t line_number = 0;
  for (std::string line; std::getline(file, line);) {
    ++line_number;
    const Columns words = columns_in(line);
    if (words.empty() || is_comment(line)) continue;
    const auto row = numbers(words);
    if (!row) {
      if (names.empty() && !columns) {
        names = words;
        continue;
      }
      fail(ErrorKind::input, "{}: line {} is no row of numbers: '{}'", path, line_number,
           line.substr(0, 60));
    }
    if (!columns && row->size() == 1) continue;  // .pts begins with the number of its points
    if (names.empty()) names = names_for(*row, path);
    if (row->size() != names.size()) {
      fail(ErrorKind::input, "{}: line {} has {} columns, others have {}", path, line_number,
           row->size(), names.size());
    }
    if (!columns) {
      check_memory_for(bytes / (line.size() + 1), path, "has, if lines are as long as the first,");
      columns.emplace(columns_of(names, *row, path));
    }
    columns->add(*row);
  }
  if (!columns) fail(ErrorKind::input, "{}: holds no points", path);
  return std::move(*columns).take();
}

}  // namespace defray
