#include "validation/case.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <functional>
#include <map>
#include <set>

#include "base/error.h"
#include "base/text.h"

namespace defray::validation {
namespace {

const std::map<std::string, Pattern> pattern_names = {
    {"constant", Pattern::constant}, {"slanted", Pattern::slanted},
    {"steps", Pattern::steps},       {"random", Pattern::random},
    {"ties", Pattern::ties},         {"converging", Pattern::converging},
    {"checker", Pattern::checker},   {"sparse", Pattern::sparse}};

const std::map<std::string, Colours> colours_names = {{"plain", Colours::plain},
                                                      {"wild", Colours::wild},
                                                      {"extreme", Colours::extreme},
                                                      {"nonfinite", Colours::nonfinite}};

template <typename T>
std::string name_of(const std::map<std::string, T>& names, T value) {
  for (const auto& [name, v] : names) {
    if (v == value) return name;
  }
  return "";
}

template <typename T>
T number(const std::string& word, const std::string& text, double least, double most) {
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool is_number = error == std::errc() && end == text.data() + text.size();
  if (!is_number || !(static_cast<double>(value) >= least && static_cast<double>(value) <= most)) {
    fail(ErrorKind::usage, "{}: '{}' is not valid: '{}' must be a number from {} to {}",
         defray::field("case"), word, text, least, most);
  }
  return value;
}

/// "WIDTHxHEIGHT".
void read_pair(const std::string& word, const std::string& text, int most, int& a, int& b) {
  const std::vector<std::string> parts = split(text, 'x');
  if (parts.size() != 2) {
    fail(ErrorKind::usage, "{}: '{}' is not valid: write two numbers as 64x48",
         defray::field("case"), word);
  }
  a = number<int>(word, parts[0], 1, most);
  b = number<int>(word, parts[1], 1, most);
}

using Read = std::function<void(Case&, const std::string& word, const std::string& value)>;

template <typename T>
Read field(T Case::*member, double least, double most) {
  return [=](Case& c, const std::string& word, const std::string& value) {
    c.*member = number<T>(word, value, least, most);
  };
}

const std::map<std::string, Read> case_fields = {
    {"coc", field(&Case::coc_px, 0, 4194303)},
    {"channels", field(&Case::channels, 1, 4)},
    {"cells", field(&Case::cells, 1, 64)},
    {"samples", field(&Case::samples, 1, 1024)},
    {"band", field(&Case::band_rows, 0, 65536)},
    {"focus", field(&Case::focus, 0.0501, HUGE_VAL)},
    {"seed", field(&Case::seed, 0, 4294967295.0)},
    {"group", [](Case& c, const std::string& word, const std::string& value) {
       read_pair(word, value, 4096, c.group_x, c.group_y);
     }}};

void read_word(Case& c, const std::string& word) {
  if (pattern_names.count(word)) {
    c.pattern = pattern_names.at(word);
  } else if (colours_names.count(word)) {
    c.colours = colours_names.at(word);
  } else if (word == "jitter") {
    c.jitter = true;
  } else if (const auto equals = word.find('=');
             equals != std::string::npos && case_fields.count(word.substr(0, equals))) {
    case_fields.at(word.substr(0, equals))(c, word, word.substr(equals + 1));
  } else if (!word.empty() && word[0] >= '0' && word[0] <= '9') {
    read_pair(word, word, 65536, c.width, c.height);
  } else {
    std::vector<std::string> known{"jitter"};
    for (const auto& [name, pattern] : pattern_names) known.push_back(name);
    for (const auto& [name, kind] : colours_names) known.push_back(name);
    for (const auto& [name, read] : case_fields) known.push_back(name);
    const std::string name = word.substr(0, equals);
    if (case_fields.count(word))
      fail(ErrorKind::usage, "{0}: '{1}' needs a value: {1}=...", defray::field("case"), word);
    if (name == "jitter")
      fail(ErrorKind::usage, "{}: jitter takes no value, '{}' has one", defray::field("case"),
           word);
    fail(ErrorKind::usage, "{}: '{}' is not known.{} Allowed: WIDTHxHEIGHT {}",
         defray::field("case"), word, did_you_mean(name, known), join(known, " "));
  }
}

/// What a word is about: no case says one thing twice.
std::string subject_of(const std::string& word) {
  if (pattern_names.count(word)) return "a pattern";
  if (colours_names.count(word)) return "colours";
  if (!word.empty() && word[0] >= '0' && word[0] <= '9') return "a size";
  return word.substr(0, word.find('='));
}

}  // namespace

std::string to_string(const Case& c) {
  const Case plain;
  std::string text =
      fmt::format("{}x{},{},coc={},{}", c.width, c.height, name_of(pattern_names, c.pattern),
                  c.coc_px, name_of(colours_names, c.colours));
  const auto add = [&](const char* name, auto value, auto standard) {
    if (value != standard) text += fmt::format(",{}={}", name, value);
  };
  add("channels", c.channels, plain.channels);
  add("cells", c.cells, plain.cells);
  add("samples", c.samples, plain.samples);
  if (c.jitter) text += ",jitter";
  add("band", c.band_rows, plain.band_rows);
  if (c.group_x > 0) text += fmt::format(",group={}x{}", c.group_x, c.group_y);
  add("focus", c.focus, plain.focus);
  add("seed", c.seed, plain.seed);
  return text;
}

Case parse_case(const std::string& text) {
  if (text.empty()) fail(ErrorKind::usage, "{} is empty", defray::field("case"));
  Case c;
  std::set<std::string> said;
  for (const std::string& word : split(text, ',')) {
    read_word(c, word);
    if (!said.insert(subject_of(word)).second) {
      fail(ErrorKind::usage, "{}: '{}' says {} for the second time", defray::field("case"), word,
           subject_of(word));
    }
  }
  if (std::int64_t{c.width} * c.height > 1 << 22) {
    fail(ErrorKind::usage, "{}: {}x{} has more than 2^22 pixels: the twins would take too long",
         defray::field("case"), c.width, c.height);
  }
  if (std::int64_t{c.width} * c.height * c.cells * c.cells > 1 << 26) {
    fail(ErrorKind::usage, "{}: {}x{} with {}x{} cells has more than 2^26 of them: too much memory",
         defray::field("case"), c.width, c.height, c.cells, c.cells);
  }
  return c;
}

}  // namespace defray::validation
