#include "options/parse.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <regex>
#include <set>

#include "options/words.h"

namespace defray::cli {
namespace {

const WordTable<double> metres_in{{"m", 1},     {"cm", 0.01},   {"mm", 0.001},
                                  {"km", 1000}, {"ft", 0.3048}, {"in", 0.0254}};

/// "meters" -> "m"; what is no unit's long name as it is.
std::string short_name(const std::string& text) {
  static const WordTable<std::string> names{
      {"metre", "m"}, {"centimetre", "cm"}, {"millimetre", "mm"}, {"kilometre", "km"},
      {"meter", "m"}, {"centimeter", "cm"}, {"millimeter", "mm"}, {"kilometer", "km"},
      {"foot", "ft"}, {"feet", "ft"},       {"inch", "in"},       {"inches", "in"}};
  const std::string lower = lower_case(text);
  for (const auto& [name, unit] : names) {
    if (lower == name || lower == name + "s") return unit;
  }
  return lower;
}

}  // namespace

double parse_unit(const std::string& text) {
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) {
    return choice("--unit", short_name(text), metres_in, ", or its length in metres");
  }
  if (!(number > 0) || std::isinf(number)) {
    fail(ErrorKind::usage, "--unit: the scene unit is {} m: it must be a finite number above 0",
         number);
  }
  return number;
}

std::string unit_of(double metres) {
  const std::string name = word_of(metres, metres_in);
  return name.empty() ? fmt::format("{}", metres) : name;
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

Window parse_window(const std::string& option, const std::string& text, bool may_be_left_of_0) {
  static const std::regex form(R"(([1-9]\d{0,5})x([1-9]\d{0,5})([+-]\d{1,6})([+-]\d{1,6}))");
  std::smatch match;
  const bool has_form = std::regex_match(text, match, form);
  if (!has_form || (!may_be_left_of_0 && text.find('-') != std::string::npos)) {
    fail(ErrorKind::usage,
         "{} '{}': write it as 3840x2160+100+50, width and height, then x and y of the left upper "
         "pixel",
         option, text);
  }
  return {std::stoi(match[3]), std::stoi(match[4]), std::stoi(match[1]), std::stoi(match[2])};
}

Window parse_size(const std::string& option, const std::string& text) {
  static const std::regex form(R"((\d{1,6})x(\d{1,6}))");
  std::smatch match;
  if (!std::regex_match(text, match, form)) {
    fail(ErrorKind::usage, "{} '{}': write it as 1920x1080", option, text);
  }
  return {0, 0, std::stoi(match[1]), std::stoi(match[2])};
}

PixelPlace parse_place(const std::string& option, const std::string& text) {
  static const std::regex form(R"((\d{1,6}),(\d{1,6}))");
  std::smatch match;
  if (!std::regex_match(text, match, form)) {
    fail(ErrorKind::usage,
         "{} '{}': write it as 640,360, a pixel of the display window from its left upper corner",
         option, text);
  }
  return {std::stoi(match[1]), std::stoi(match[2])};
}

std::array<double, 3> parse_point(const std::string& option, const std::string& text) {
  const std::vector<std::string> parts = split(text, ',');
  std::array<double, 3> point{};
  for (std::size_t i = 0; i < 3; ++i) {
    char* end = nullptr;
    const std::string part = parts.size() == 3 ? parts[i] : "";
    point[i] = std::strtod(part.c_str(), &end);
    if (part.empty() || *end != '\0' || !std::isfinite(point[i])) {
      fail(ErrorKind::usage, "{} '{}': write it as 1,2.5,-3", option, text);
    }
  }
  return point;
}

double parse_seconds(const std::string& option, const std::string& text) {
  static const std::regex form(R"((\d{1,6}(?:\.\d{1,6})?)([smh]?))");
  std::smatch match;
  if (std::regex_match(text, match, form)) {
    const double seconds = std::stod(match[1]) * (match[2] == "h"   ? 3600
                                                  : match[2] == "m" ? 60
                                                                    : 1);
    if (seconds > 0) return seconds;
  }
  fail(ErrorKind::usage, "{} '{}': write it as 90s, 10m or 1h, above 0", option, text);
}

std::vector<WorkGroup> parse_work_groups(const std::string& text) {
  static const std::regex form(R"((?:([a-z]\w*)=)?([1-9]\d{0,5})(?:x([1-9]\d{0,5}))?)");
  std::vector<WorkGroup> groups;
  std::set<std::string> named;
  for (const std::string& part : split(text + ",", ',')) {  // "" is one empty part
    std::smatch match;
    if (!std::regex_match(part, match, form)) {
      fail(ErrorKind::usage, "--work-group '{}': write it as 64 or 64x1, for one kernel fill=8x8",
           text);
    }
    const std::string kernel = match[1];
    if (!named.insert(kernel).second) {
      fail(ErrorKind::usage, "--work-group '{}' says {} for the second time", text,
           kernel.empty() ? "that of all kernels" : kernel);
    }
    groups.push_back({kernel, std::stoul(match[2]), match[3].matched ? std::stoul(match[3]) : 1});
  }
  std::stable_partition(groups.begin(), groups.end(),
                        [](const WorkGroup& group) { return group.kernel.empty(); });
  return groups;
}

}  // namespace defray::cli
