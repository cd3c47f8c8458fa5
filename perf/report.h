#pragma once
// What an experiment found, as files: a CSV a table, and one HTML page for people.
#include <string>
#include <vector>

namespace defray::perf {

/// Figures, as text ready to be read. Written to <file>.csv too.
struct Table {
  std::string file;  ///< Without extension.
  std::string caption;
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;
};

/// A picture or plot that lies in the report's folder.
struct Figure {
  std::string file, caption;
};

/// One experiment's part of the report.
struct Section {
  std::string title;
  std::string claim;                  ///< What the paper says.
  std::vector<std::string> findings;  ///< What was measured, in sentences.
  std::vector<Table> tables;
  std::vector<Figure> figures;
};

/// Writes every table as CSV and all sections as `folder`/index.html. Throws Error(output).
void write_report(const std::string& folder, const std::string& machine,
                  const std::vector<Section>& sections);

}  // namespace defray::perf
