#include "tables/markers.h"

#include <algorithm>
#include <regex>

#include "base/error.h"

namespace defray::perf {
namespace {

struct Marked {
  std::string name;
  std::size_t begin, end;  ///< What stands between the markers' lines.
};

struct Marker {
  std::string name;
  bool is_begin;
  std::size_t line_begin, line_end;  ///< `line_end`: where the next line begins.
};

std::vector<Marker> markers_of(const std::string& text) {
  static const std::regex pattern("<!-- ([a-z0-9_-]+):(begin|end) -->\\s*");
  std::vector<Marker> markers;
  for (std::size_t begin = 0, end = 0; begin < text.size(); begin = end) {
    end = std::min(text.find('\n', begin), text.size() - 1) + 1;
    const std::string line = text.substr(begin, end - begin);
    std::smatch match;
    if (!std::regex_match(line, match, pattern)) continue;
    markers.push_back({match[1].str(), match[2].str() == "begin", begin, end});
  }
  return markers;
}

std::vector<Marked> places_of(const std::string& text, const std::string& path) {
  const std::vector<Marker> markers = markers_of(text);
  std::vector<Marked> places;
  for (std::size_t i = 0; i < markers.size(); i += 2) {
    const Marker& m = markers[i];
    const bool has_end =
        i + 1 < markers.size() && !markers[i + 1].is_begin && markers[i + 1].name == m.name;
    if (!m.is_begin || !has_end) {
      fail(ErrorKind::input, "{}: marker '<!-- {}:{} -->' has no {}", path, m.name,
           m.is_begin ? "begin" : "end", m.is_begin ? "end that follows" : "begin before it");
    }
    for (const Marked& other : places) {
      if (other.name == m.name) {
        fail(ErrorKind::input, "{}: markers of '{}' stand there twice", path, m.name);
      }
    }
    places.push_back({m.name, m.line_end, markers[i + 1].line_begin});
  }
  return places;
}

}  // namespace

std::vector<std::string> marked_names(const std::string& text, const std::string& path) {
  std::vector<std::string> names;
  for (const Marked& place : places_of(text, path)) names.push_back(place.name);
  return names;
}

std::string with_marked(const std::string& text, const std::string& path, const std::string& name,
                        const std::string& content) {
  for (const Marked& place : places_of(text, path)) {
    if (place.name != name) continue;
    return text.substr(0, place.begin) + content + text.substr(place.end);
  }
  fail(ErrorKind::input, "{}: has no markers '<!-- {}:begin -->' and '<!-- {}:end -->'", path, name,
       name);
}

}  // namespace defray::perf
