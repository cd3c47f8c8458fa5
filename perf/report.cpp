#include "report.h"

#include <fstream>

#include "error.h"
#include "image/safe_output.h"
#include "text.h"

namespace defray::perf {
namespace {

constexpr const char* head = R"(<!doctype html>
<html lang="en"><head><meta charset="utf-8"><title>defray: the papers' experiments</title>
<meta name="viewport" content="width=device-width">
<style>
body { font: 16px/1.5 sans-serif; max-width: 72rem; margin: 2rem auto; padding: 0 1rem }
table { border-collapse: collapse; margin: .5rem 0 1.5rem; font-size: 14px }
caption { text-align: left; font-weight: bold }
td, th { border: 1px solid #bbb; padding: .2rem .6rem; text-align: right }
td:first-child, th:first-child { text-align: left }
td.command { text-align: left; font-family: monospace; font-size: 12px }
img { max-width: 100%; border: 1px solid #ccc } figure { margin: 1rem 0 2rem }
.claim { border-left: .3rem solid #888; padding-left: 1rem; color: #444 }
</style></head><body>
)";

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '&')
      out += "&amp;";
    else if (c == '"')
      out += "&quot;";
    else
      out += c;
  }
  return out;
}

/// A field of RFC 4180: quoted where it has to be.
std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

std::string csv_line(const std::vector<std::string>& fields) {
  std::vector<std::string> quoted;
  for (const std::string& field : fields) quoted.push_back(csv_field(field));
  return join(quoted, ",") + "\n";
}

void write_text(const std::string& path, const std::string& text) {
  write_safely(path, [&](const std::string& name) {
    std::ofstream stream(name);
    stream << text;
    if (!stream.flush()) fail(ExitCode::output, "{}: cannot write", name);
  });
}

std::string html_table(const Table& table) {
  std::string html = "<table><caption>" + escaped(table.caption) + " (<a href=\"" + table.file +
                     ".csv\">CSV</a>)</caption>\n<tr>";
  for (const std::string& column : table.columns) html += "<th>" + escaped(column) + "</th>";
  html += "</tr>\n";
  for (const auto& row : table.rows) {
    html += "<tr>";
    for (const std::string& field : row) {
      const bool is_command = field.rfind("defray ", 0) == 0;
      html += (is_command ? "<td class=\"command\">" : "<td>") + escaped(field) + "</td>";
    }
    html += "</tr>\n";
  }
  return html + "</table>\n";
}

std::string html_section(const Section& section) {
  std::string html = "<h2>" + escaped(section.title) + "</h2>\n<p class=\"claim\">" +
                     escaped(section.claim) + "</p>\n";
  for (const std::string& finding : section.findings) html += "<p>" + escaped(finding) + "</p>\n";
  for (const Table& table : section.tables) html += html_table(table);
  for (const Figure& figure : section.figures) {
    html += "<figure><a href=\"" + figure.file + "\"><img src=\"" + figure.file + "\" alt=\"" +
            escaped(figure.caption) + "\"></a><figcaption>" + escaped(figure.caption) +
            "</figcaption></figure>\n";
  }
  return html;
}

}  // namespace

void write_report(const std::string& folder, const std::string& machine,
                  const std::vector<Section>& sections) {
  std::string html = head;
  html += "<h1>defray: the papers' experiments</h1>\n<p>Measured on " + escaped(machine) +
          ". Times are medians with their spread (largest minus smallest, in percent of the "
          "median); on a shared machine trust ratios within one table.</p>\n";
  for (const Section& section : sections) {
    html += html_section(section);
    for (const Table& table : section.tables) {
      std::string csv = csv_line(table.columns);
      for (const auto& row : table.rows) csv += csv_line(row);
      write_text(folder + "/" + table.file + ".csv", csv);
    }
  }
  write_text(folder + "/index.html", html + "</body></html>\n");
}

}  // namespace defray::perf
