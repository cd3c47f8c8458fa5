#include "html_report.h"

#include <OpenImageIO/strutil.h>

#include <fstream>
#include <functional>
#include <sstream>

#include "error.h"
#include "image/safe_output.h"
#include "text.h"

namespace defray {
namespace {

constexpr const char* head = R"(<!doctype html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width">
<style>
body { font: 16px/1.5 sans-serif; max-width: 72rem; margin: 2rem auto; padding: 0 1rem }
table { border-collapse: collapse; margin: .5rem 0 1.5rem; font-size: 14px }
caption { text-align: left; font-weight: bold }
td, th { border: 1px solid #bbb; padding: .2rem .6rem; text-align: right }
td:first-child, th:first-child { text-align: left }
td.pass { background: #d7f0d7 } td.fail { background: #ffd0d0; font-weight: bold }
td.command { text-align: left; font-family: monospace; font-size: 12px }
img { max-width: 100%; border: 1px solid #ccc } figure { margin: 1rem 0 2rem }
.claim { border-left: .3rem solid #888; padding-left: 1rem; color: #444 }
</style>
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

const char* class_of(const std::string& field) {
  if (field.rfind("defray ", 0) == 0) return " class=\"command\"";
  if (field == "PASS") return " class=\"pass\"";
  return field == "FAIL" ? " class=\"fail\"" : "";
}

std::string html_table(const Table& table) {
  std::string html = "<table><caption>" + escaped(table.caption);
  if (!table.file.empty()) html += " (<a href=\"" + table.file + ".csv\">CSV</a>)";
  html += "</caption>\n<tr>";
  for (const std::string& column : table.columns) html += "<th>" + escaped(column) + "</th>";
  html += "</tr>\n";
  for (const auto& row : table.rows) {
    html += "<tr>";
    for (const std::string& field : row) {
      html += std::string("<td") + class_of(field) + ">" + escaped(field) + "</td>";
    }
    html += "</tr>\n";
  }
  return html + "</table>\n";
}

/// Where the page finds a picture: its name, or its bytes.
using Address = std::function<std::string(const std::string& file)>;

std::string html_section(const Section& section, const Address& address) {
  std::string html = "<h2>" + escaped(section.title) + "</h2>\n";
  if (!section.claim.empty()) html += "<p class=\"claim\">" + escaped(section.claim) + "</p>\n";
  for (const std::string& finding : section.findings) html += "<p>" + escaped(finding) + "</p>\n";
  for (const Table& table : section.tables) html += html_table(table);
  for (const Figure& figure : section.figures) {
    html += "<figure><img src=\"" + address(figure.file) + "\" alt=\"" + escaped(figure.caption) +
            "\"><figcaption>" + escaped(figure.caption) + "</figcaption></figure>\n";
  }
  return html;
}

std::string html_page(const Page& page, const Address& address) {
  std::string html = head;
  html += "<title>" + escaped(page.title) + "</title></head><body>\n<h1>" + escaped(page.title) +
          "</h1>\n<p>" + escaped(page.intro) + "</p>\n";
  for (const Section& section : page.sections) html += html_section(section, address);
  return html + "</body></html>\n";
}

std::string data_address(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  std::ostringstream bytes;
  bytes << stream.rdbuf();
  return "data:image/png;base64," + OIIO::Strutil::base64_encode(bytes.str());
}

}  // namespace

void write_page(const std::string& folder, const Page& page) {
  for (const Section& section : page.sections) {
    for (const Table& table : section.tables) {
      std::string csv = csv_line(table.columns);
      for (const auto& row : table.rows) csv += csv_line(row);
      write_text(folder + "/" + table.file + ".csv", csv);
    }
  }
  write_text(folder + "/index.html", html_page(page, [](const std::string& file) { return file; }));
}

void write_single_file(const std::string& path, const Page& page, const std::string& folder) {
  write_text(path, html_page(page, [&](const std::string& file) {
               return data_address(folder + "/" + file);
             }));
}

}  // namespace defray
