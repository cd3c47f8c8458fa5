// PLY files, row by row. Debian has no reader that is small and takes all properties: PCL's brings
// VTK, OpenCV 4.6 none, assimp's drops what is no mesh.
#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>
#include <sstream>

#include "base/error.h"
#include "base/text.h"
#include "splat/clouds/cloud_columns.h"
#include "splat/clouds/ply_header.h"

namespace defray {
namespace {

template <typename T>
double number_of(const unsigned char* bytes, bool is_swapped) {
  unsigned char own[sizeof(T)];
  std::memcpy(own, bytes, sizeof(T));
  if (is_swapped) std::reverse(own, own + sizeof(T));
  T value;
  std::memcpy(&value, own, sizeof(T));
  return static_cast<double>(value);
}

double number_of(const unsigned char* bytes, PlyType type, bool is_swapped) {
  switch (type) {
    case PlyType::int8:
      return number_of<std::int8_t>(bytes, is_swapped);
    case PlyType::uint8:
      return number_of<std::uint8_t>(bytes, is_swapped);
    case PlyType::int16:
      return number_of<std::int16_t>(bytes, is_swapped);
    case PlyType::uint16:
      return number_of<std::uint16_t>(bytes, is_swapped);
    case PlyType::int32:
      return number_of<std::int32_t>(bytes, is_swapped);
    case PlyType::uint32:
      return number_of<std::uint32_t>(bytes, is_swapped);
    case PlyType::float32:
      return number_of<float>(bytes, is_swapped);
    case PlyType::float64:
      return number_of<double>(bytes, is_swapped);
  }
  fail(ErrorKind::internal, "a PLY type without a reader");
}

/// The numbers of a body, one after the other.
class PlyBody {
 public:
  PlyBody(std::istream& file, PlyFormat format, const std::string& path)
      : file_(file), format_(format), path_(path) {}

  /// A row's numbers; of a list, nothing. `what` and `index` are for messages.
  void read_row(const PlyElement& element, std::uint64_t index, std::vector<double>& row) {
    row.clear();
    const auto next = [&](PlyType type) {
      const double value = format_ == PlyFormat::ascii ? word(element) : binary(type);
      if (!file_) {
        fail(ErrorKind::input, "{}: ends within element '{}', at {} of {}: it is cut off", path_,
             element.name, index, element.count);
      }
      return value;
    };
    for (const PlyProperty& p : element.properties) {
      if (!p.is_list) {
        row.push_back(next(p.type));
        continue;
      }
      const double count = next(p.count_type);
      for (double i = 0; i < count; ++i) next(p.type);
      row.push_back(0);
    }
  }

  /// After the last element: the header may have counted too few. Less than a row may follow.
  void check_end(const PlyElement& last) {
    std::uint64_t rest = 0;
    std::string text;
    if (format_ == PlyFormat::ascii) {
      if (file_ >> text) rest = 1 + text.size();
    } else {
      while (rest < last.row_bytes() && file_.get() != std::istream::traits_type::eof()) ++rest;
    }
    const std::uint64_t row = format_ == PlyFormat::ascii ? 1 : last.row_bytes();
    if (rest < row || row == 0) return;
    fail(ErrorKind::input, "{}: goes on after the {} rows of element '{}': its header is wrong",
         path_, last.count, last.name);
  }

 private:
  double binary(PlyType type) {
    unsigned char bytes[8] = {};
    file_.read(reinterpret_cast<char*>(bytes), bytes_of(type));
    const bool is_swapped =
        (format_ == PlyFormat::big) == (std::endian::native == std::endian::little);
    return number_of(bytes, type, is_swapped);
  }

  /// By strtod, which reads nan and inf where a stream does not.
  double word(const PlyElement& element) {
    std::string text;
    if (!(file_ >> text)) return 0;
    char* end = nullptr;
    const double value = std::strtod(text.c_str(), &end);
    if (*end != '\0') {
      fail(ErrorKind::input, "{}: line {} has '{}' where a number of element '{}' should be", path_,
           line(), text.substr(0, 40), element.name);
    }
    return value;
  }

  /// Of the file, counted from 1, that reading has come to.
  std::ptrdiff_t line() {
    file_.clear();  // the file may end there
    const std::streamoff read = file_.tellg();
    file_.seekg(0);
    std::string text(static_cast<std::size_t>(read), '\0');
    file_.read(text.data(), read);
    return 1 + std::count(text.begin(), text.end(), '\n');
  }

  std::istream& file_;
  PlyFormat format_;
  const std::string& path_;
};

/// What a colour's whole numbers go to; 0 of floats.
double largest_of(PlyType type) {
  switch (type) {
    case PlyType::int8:
    case PlyType::uint8:
      return 255;
    case PlyType::int16:
    case PlyType::uint16:
      return 65535;
    case PlyType::int32:
    case PlyType::uint32:
      return std::numeric_limits<std::uint32_t>::max();
    case PlyType::float32:
    case PlyType::float64:
      return 0;
  }
  return 0;
}

/// Before anything is allocated: a header can say what it likes.
void check_count(const PlyElement& vertices, PlyFormat format, std::uint64_t bytes,
                 const std::string& path) {
  const std::uint64_t least =
      format == PlyFormat::ascii ? 2 * vertices.properties.size() : vertices.row_bytes();
  if (least > 0 && vertices.count > (bytes + 1) / least) {
    fail(ErrorKind::input,
         "{}: its header says {} points of at least {} bytes, the file has {} after it: it is cut "
         "off, or its header wrong",
         path, vertices.count, least, bytes);
  }
  check_memory_for(vertices.count, path);
}

CloudColumns columns_of(const PlyElement& vertices, const std::string& path) {
  std::vector<std::string> names;
  std::vector<double> whole_numbers;
  for (const PlyProperty& p : vertices.properties) {
    names.push_back(p.is_list ? "" : p.name);
    whole_numbers.push_back(largest_of(p.type));
  }
  return {names, whole_numbers, path};
}

}  // namespace

PointCloud read_ply(std::istream& file, std::uint64_t bytes, const std::string& path) {
  const PlyHeader header = read_ply_header(file, path);
  PlyBody body(file, header.format, path);
  const std::uint64_t left =
      bytes - std::min<std::uint64_t>(bytes, static_cast<std::uint64_t>(file.tellg()));
  std::vector<double> row;
  std::vector<std::string> unused;
  for (const PlyElement& element : header.elements) {
    if (element.name != "vertex" && element.count > 0) unused.push_back("element " + element.name);
  }
  for (const PlyElement& element : header.elements) {
    if (element.name != "vertex") {
      // It has at least a byte a row where it has anything.
      const std::uint64_t rows = element.properties.empty() ? 0 : element.count;
      for (std::uint64_t i = 0; i < rows; ++i) body.read_row(element, i, row);
      continue;
    }
    CloudColumns columns = columns_of(element, path);
    check_count(element, header.format, left, path);
    columns.reserve(element.count);
    for (std::uint64_t i = 0; i < element.count; ++i) {
      body.read_row(element, i, row);
      columns.add(row);
    }
    if (&element == &header.elements.back()) body.check_end(element);
    PointCloud cloud = std::move(columns).take();
    if (!unused.empty()) cloud.notes.push_back("not used: " + join(unused, ", "));
    return cloud;
  }
  fail(ErrorKind::input, "{}: has no element 'vertex', and so no points", path);
}

}  // namespace defray
