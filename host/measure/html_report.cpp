#include "measure/html_report.h"

#include <OpenImageIO/strutil.h>

#include <fstream>
#include <functional>
#include <sstream>

#include "base/error.h"
#include "base/text.h"
#include "image/safe_output.h"

namespace defray {
namespace {

constexpr const char* head = R"(<!doctype html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width">
<style>
body { font: 16px/1.5 sans-serif; max-width: 72rem; margin: 2rem auto; padding: 0 1rem }
.wide { overflow-x: auto; margin: .5rem 0 1.5rem }
table { border-collapse: collapse; font-size: 14px }
caption { text-align: left; font-weight: bold; white-space: nowrap }
td, th { border: 1px solid #bbb; padding: .2rem .6rem; text-align: right; vertical-align: top }
td:first-child, th:first-child, .text { text-align: left }
.text { min-width: 13em }
td.pass { background: #d7f0d7 } td.fail { background: #ffd0d0; font-weight: bold }
td.command { font-family: monospace; font-size: 12px; min-width: 30em }
img { max-width: 100%; border: 1px solid #ccc } figure { margin: 1rem 0 2rem }
figcaption { overflow-wrap: anywhere }
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
  if (field.find("defray ") != std::string::npos) return "command";
  if (field == "PASS") return "pass";
  return field == "FAIL" ? "fail" : "";
}

/// Columns of sentences; the others hold numbers or a word.
std::vector<bool> text_columns(const Table& table) {
  constexpr std::size_t longest_figure = 16;
  std::vector<bool> is_text(table.columns.size());
  for (const auto& row : table.rows) {
    for (std::size_t c = 0; c < row.size(); ++c) {
      if (row[c].size() > longest_figure) is_text[c] = true;
    }
  }
  return is_text;
}

std::string cell(const char* tag, const std::string& field, bool is_text) {
  const std::string kind = fmt::format("{} {}", class_of(field), is_text ? "text" : "");
  return kind == " " ? fmt::format("<{}>{}</{}>", tag, escaped(field), tag)
                     : fmt::format("<{} class=\"{}\">{}</{}>", tag, kind, escaped(field), tag);
}

std::string html_table(const Table& table) {
  const std::vector<bool> is_text = text_columns(table);
  const auto line = [&](const char* tag, const std::vector<std::string>& fields) {
    std::string html = "<tr>";
    for (std::size_t c = 0; c < fields.size(); ++c) html += cell(tag, fields[c], is_text[c]);
    return html + "</tr>\n";
  };
  std::string html = "<div class=\"wide\"><table><caption>" + escaped(table.caption);
  if (!table.file.empty()) html += " (<a href=\"" + table.file + ".csv\">CSV</a>)";
  html += "</caption>\n" + line("th", table.columns);
  for (const auto& row : table.rows) html += line("td", row);
  return html + "</table></div>\n";
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
      const bool has_own = !table.csv_columns.empty();
      std::string csv = csv_line(has_own ? table.csv_columns : table.columns);
      for (const auto& row : has_own ? table.csv_rows : table.rows) csv += csv_line(row);
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
