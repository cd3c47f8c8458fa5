#pragma once
// What was measured, as an HTML page for people.
#include <string>
#include <vector>

namespace defray {

/// Figures, as text ready to be read. A cell of PASS or FAIL is coloured.
struct Table {
  std::string file;  ///< Of its CSV, without extension; empty: none.
  std::string caption;
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;
  /// Of the CSV, where that has other ones than the page: bare numbers.
  std::vector<std::string> csv_columns = {};
  std::vector<std::vector<std::string>> csv_rows = {};
};

/// A picture or plot that lies in the report's folder.
struct Figure {
  std::string file, caption;
};

/// A part of the page.
struct Section {
  std::string title;
  std::string claim;                  ///< What is claimed or asked, set apart.
  std::vector<std::string> findings;  ///< What was measured, in sentences.
  std::vector<Table> tables;
  std::vector<Figure> figures;
};

struct Page {
  std::string title, intro;
  std::vector<Section> sections;
};

/// Writes `folder`/index.html, and every table as CSV beside it. Throws Error(output).
void write_page(const std::string& folder, const Page& page);

/// Writes the page as one file that holds its pictures, which lie in `folder`. Throws
/// Error(output).
void write_single_file(const std::string& path, const Page& page, const std::string& folder);

}  // namespace defray
