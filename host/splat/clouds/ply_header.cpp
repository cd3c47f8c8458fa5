#include "splat/clouds/ply_header.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <sstream>
#include <utility>

#include "base/error.h"

namespace defray {
namespace {

/// Longer lines are no header.
constexpr std::size_t longest_line = 4096;
constexpr int most_lines = 10000;

constexpr std::array<std::pair<const char*, PlyType>, 16> type_words{
    {{"char", PlyType::int8},
     {"int8", PlyType::int8},
     {"uchar", PlyType::uint8},
     {"uint8", PlyType::uint8},
     {"short", PlyType::int16},
     {"int16", PlyType::int16},
     {"ushort", PlyType::uint16},
     {"uint16", PlyType::uint16},
     {"int", PlyType::int32},
     {"int32", PlyType::int32},
     {"uint", PlyType::uint32},
     {"uint32", PlyType::uint32},
     {"float", PlyType::float32},
     {"float32", PlyType::float32},
     {"double", PlyType::float64},
     {"float64", PlyType::float64}}};

class HeaderReader {
 public:
  HeaderReader(std::istream& file, const std::string& path) : file_(file), path_(path) {}

  PlyHeader read() {
    if (next_line() != "ply")
      fail(ErrorKind::input, "{}: no PLY file: it does not begin with a line 'ply'", path_);
    PlyHeader header;
    bool has_format = false;
    for (int i = 0; i < most_lines; ++i) {
      std::istringstream words(next_line());
      std::string word;
      words >> word;
      if (word == "end_header") {
        if (!has_format) fail(ErrorKind::input, "{}: its header has no format", path_);
        return header;
      }
      if (word == "format") {
        header.format = format(words);
        has_format = true;
      } else if (word == "element") {
        header.elements.push_back(element(words));
      } else if (word == "property") {
        if (header.elements.empty()) wrong("a property before every element");
        header.elements.back().properties.push_back(property(words));
      } else if (!word.empty() && word != "comment" && word != "obj_info") {
        wrong("'" + word + "'");
      }
    }
    wrong("no end_header");
  }

 private:
  [[noreturn]] void wrong(const std::string& what) const {
    fail(ErrorKind::input, "{}: its PLY header has {} in line {}", path_, what, line_);
  }

  std::string next_line() {
    ++line_;
    std::string line;
    for (char c; file_.get(c) && c != '\n';) {
      if (line.size() == longest_line) wrong("no end");
      line.push_back(c);
    }
    if (!file_) fail(ErrorKind::input, "{}: ends within its PLY header, in line {}", path_, line_);
    if (!line.empty() && line.back() == '\r') line.pop_back();
    return line;
  }

  PlyFormat format(std::istringstream& words) const {
    std::string name;
    words >> name;
    if (name == "ascii") return PlyFormat::ascii;
    if (name == "binary_little_endian") return PlyFormat::little;
    if (name == "binary_big_endian") return PlyFormat::big;
    wrong("the format '" + name + "'");
  }

  PlyElement element(std::istringstream& words) const {
    PlyElement made;
    std::string count;
    words >> made.name >> count;
    const auto [end, error] =
        std::from_chars(count.data(), count.data() + count.size(), made.count);
    if (made.name.empty() || count.empty() || error != std::errc() ||
        end != count.data() + count.size()) {
      wrong("the count '" + count + "' of element '" + made.name + "'");
    }
    return made;
  }

  PlyType type(const std::string& word) const {
    const auto found = std::find_if(type_words.begin(), type_words.end(),
                                    [&](const auto& known) { return word == known.first; });
    if (found == type_words.end()) wrong("the type '" + word + "'");
    return found->second;
  }

  PlyProperty property(std::istringstream& words) const {
    PlyProperty made;
    std::string word;
    words >> word;
    if (word == "list") {
      std::string count;
      words >> count >> word;
      made.is_list = true;
      made.count_type = type(count);
      if (made.count_type == PlyType::float32 || made.count_type == PlyType::float64) {
        wrong("the type '" + count + "' of a list's length");
      }
    }
    made.type = type(word);
    words >> made.name;
    if (made.name.empty()) wrong("a property without a name");
    return made;
  }

  std::istream& file_;
  const std::string& path_;
  int line_ = 0;
};

}  // namespace

int bytes_of(PlyType type) {
  switch (type) {
    case PlyType::int8:
    case PlyType::uint8:
      return 1;
    case PlyType::int16:
    case PlyType::uint16:
      return 2;
    case PlyType::int32:
    case PlyType::uint32:
    case PlyType::float32:
      return 4;
    case PlyType::float64:
      return 8;
  }
  fail(ErrorKind::internal, "a PLY type without a size");
}

std::uint64_t PlyElement::row_bytes() const {
  std::uint64_t bytes = 0;
  for (const PlyProperty& p : properties) bytes += static_cast<std::uint64_t>(bytes_of(p.type));
  return bytes;
}

PlyHeader read_ply_header(std::istream& file, const std::string& path) {
  return HeaderReader(file, path).read();
}

}  // namespace defray
