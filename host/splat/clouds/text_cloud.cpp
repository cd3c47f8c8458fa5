// Clouds as text: a point a line, numbers with spaces, tabs, and commas or semicolons between them;
// lines that begin with # or // are comments; a first line of names says what the columns are. Read
// twice: what colours are, and what columns without names, all rows together say.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <istream>
#include <optional>

#include "base/error.h"
#include "base/text.h"
#include "splat/clouds/cloud_columns.h"

namespace defray {
namespace {

using Columns = std::vector<std::string>;

/// Between two commas or semicolons there is a column, even an empty one.
Columns columns_in(const std::string& line) {
  Columns words;
  std::string word;
  bool is_after_mark = false;
  for (const char c : line + ' ') {
    const bool is_mark = c == ',' || c == ';';
    if (!is_mark && c != ' ' && c != '\t' && c != '\r' && c != '"') {
      word.push_back(c);
      continue;
    }
    if (!word.empty()) {
      words.push_back(std::exchange(word, {}));
      is_after_mark = false;
    }
    if (is_mark && is_after_mark) words.emplace_back();
    is_after_mark = is_after_mark || is_mark;
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

/// "0,10;2,5": semicolons part the columns of files whose numbers have commas.
bool has_decimal_commas(const std::string& line) {
  const std::size_t comma = line.find(',');
  return comma != std::string::npos && comma > 0 && line.find(';') != std::string::npos &&
         std::isdigit(static_cast<unsigned char>(line[comma - 1])) &&
         std::isdigit(static_cast<unsigned char>(line[comma + 1]));
}

/// The rows of a file, as often as it is read.
class TextRows {
 public:
  TextRows(std::istream& file, const std::string& path) : file_(file), path_(path) {}

  Columns names;                ///< Of the columns, where the file has them.
  std::optional<double> count;  ///< .pts begins with the number of its points.

  /// All of them, with their lines.
  void each(const std::function<void(const std::vector<double>&, const std::string&)>& visit) {
    file_.clear();
    file_.seekg(0);
    std::size_t columns = 0;
    std::uint64_t line_number = 0;
    for (std::string line; std::getline(file_, line);) {
      if (++line_number == 1 && line.starts_with("\xef\xbb\xbf")) line.erase(0, 3);
      const Columns words = columns_in(line);
      if (words.empty() || is_comment(line)) continue;
      const auto row = numbers(words);
      const auto wrong = [&](const std::string& what) {
        fail(ErrorKind::input, "{}: line {} {}: '{}'", path_, line_number, what,
             line.substr(0, 60));
      };
      if (!row && columns == 0) {
        columns = words.size();
        names = words;
        continue;
      }
      if (!row) wrong("is no row of numbers");
      if (has_decimal_commas(line)) wrong("has commas and semicolons: decimals need a point");
      if (row->size() == 1 && columns == 0) {
        count = row->front();
        continue;
      }
      if (columns == 0) columns = row->size();
      if (row->size() != columns) {
        fail(ErrorKind::input, "{}: line {} has {} columns, others have {}", path_, line_number,
             row->size(), columns);
      }
      visit(*row, line);
    }
  }

 private:
  std::istream& file_;
  const std::string& path_;
};

/// What a column holds, over all rows.
struct ColumnContent {
  bool is_byte = true;  ///< Whole numbers from 0 to 255.
  double largest = 0;

  void add(double v) {
    is_byte = is_byte && v >= 0 && v <= 255 && v == std::floor(v);
    largest = std::fmax(largest, v);
  }
};

/// Whole numbers up to 255, and not all of them 0 or 1.
bool are_bytes(const std::vector<ColumnContent>& columns) {
  return std::all_of(columns.begin(), columns.end(),
                     [](const ColumnContent& c) { return c.is_byte; }) &&
         std::any_of(columns.begin(), columns.end(),
                     [](const ColumnContent& c) { return c.largest > 1; });
}

/// What unnamed columns are, by their number and content.
Columns names_for(const std::vector<ColumnContent>& content, const std::string& path) {
  const auto are_colours = [&](std::size_t first) {
    return are_bytes({content[first], content[first + 1], content[first + 2]});
  };
  const Columns place{"x", "y", "z"}, normal{"nx", "ny", "nz"}, colour{"red", "green", "blue"};
  Columns names = place;
  const auto append = [&](const Columns& more) {
    names.insert(names.end(), more.begin(), more.end());
  };
  if (content.size() == 6) append(are_colours(3) ? colour : normal);
  if (content.size() == 9) {
    append(are_colours(3) && !are_colours(6) ? colour : normal);
    append(names.back() == "blue" ? normal : colour);
  }
  if (content.size() == 7 && are_colours(4)) {  // laser scanners' .pts
    append({"intensity"});
    append(colour);
  }
  if (names.size() != content.size()) {
    fail(ErrorKind::input,
         "{}: has {} columns: without a line of names (x y z nx ny nz red green blue alpha radius) "
         "3, 6, 9 or, with an intensity before the colour, 7 are understood",
         path, content.size());
  }
  return names;
}

/// Colours go up to 255 if all are such whole numbers; otherwise they are linear.
CloudColumns columns_of(const Columns& names, const std::vector<ColumnContent>& content,
                        const std::string& path) {
  std::vector<ColumnContent> colours;
  std::vector<std::size_t> where;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string name = lower_case(names[i]);
    const bool is_colour = name == "red" || name == "green" || name == "blue" || name == "alpha" ||
                           name == "r" || name == "g" || name == "b" || name == "a";
    if (!is_colour) continue;
    colours.push_back(content[i]);
    where.push_back(i);
  }
  std::vector<double> whole(names.size(), 0);
  for (const std::size_t i : where) whole[i] = are_bytes(colours) ? 255 : 0;
  return {names, whole, path};
}

}  // namespace

PointCloud read_text_cloud(std::istream& file, std::uint64_t bytes, const std::string& path) {
  TextRows rows(file, path);
  std::vector<ColumnContent> content;
  std::uint64_t points = 0;
  rows.each([&](const std::vector<double>& row, const std::string& line) {
    if (points++ == 0) {
      check_memory_for(bytes / (line.size() + 1), path, "has, if lines are as long as the first,");
      content.resize(row.size());
    }
    for (std::size_t i = 0; i < row.size(); ++i) content[i].add(row[i]);
  });
  if (points == 0) {
    fail(ErrorKind::input, "{}: holds no points: a line each, of numbers x y z, is needed", path);
  }
  if (rows.count && *rows.count != static_cast<double>(points)) {
    fail(ErrorKind::input, "{}: its first line says {} points, it has {}", path, *rows.count,
         points);
  }
  const Columns names = rows.names.empty() ? names_for(content, path) : rows.names;
  CloudColumns columns = columns_of(names, content, path);
  columns.reserve(points);
  rows.each([&](const std::vector<double>& row, const std::string&) { columns.add(row); });
  return std::move(columns).take();
}

}  // namespace defray
