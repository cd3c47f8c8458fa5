#include "parse.h"

#include <charconv>
#include <cmath>
#include <regex>

#include "options.h"

namespace defray::cli {

double parse_unit(const std::string& text) {
  static const std::map<std::string, double> metres{{"m", 1},     {"cm", 0.01},   {"mm", 0.001},
                                                    {"km", 1000}, {"ft", 0.3048}, {"in", 0.0254}};
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) {
    return choice("--unit", text, metres);
  }
  if (!(number > 0) || std::isinf(number)) {
    fail(ErrorKind::usage, "--unit: the scene unit is {} m: it must be a finite number above 0",
         number);
  }
  return number;
}

double parse_background(const std::string& text) {
  if (text == "none") return INFINITY;
  double number = 0;
  const bool has_plus = text.starts_with('+') && !text.starts_with("+-");  // unknown to from_chars
  const char* begin = text.data() + (has_plus ? 1 : 0);
  const auto [end, error] = std::from_chars(begin, text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size() || std::isnan(number)) {
    fail(ErrorKind::usage, "--background '{}' is neither a number nor none", text);
  }
  return number;
}

std::array<std::size_t, 2> parse_work_group(const std::string& text) {
  if (text.empty()) return {0, 0};
  static const std::regex form(R"(([1-9]\d{0,5})(?:x([1-9]\d{0,5}))?)");
  std::smatch match;
  if (!std::regex_match(text, match, form)) {
    fail(ErrorKind::usage, "--work-group '{}': write it as 64 or 64x1", text);
  }
  const std::size_t y = match[2].matched ? std::stoul(match[2]) : 1;
  return {std::stoul(match[1]), y};
}

}  // namespace defray::cli
