#pragma once
// What a PLY file says of itself (Turk 1994, "The PLY polygon file format").
#include <cstdint>
#include <istream>
#include <string>
#include <vector>

namespace defray {

enum class PlyFormat { ascii, little, big };

enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

/// In a binary file.
int bytes_of(PlyType type);

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::float32;
  bool is_list = false;
  PlyType count_type = PlyType::uint8;  ///< Of a list's length.
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;

  std::uint64_t row_bytes() const;  ///< Without lists.
};

struct PlyHeader {
  PlyFormat format = PlyFormat::ascii;
  std::vector<PlyElement> elements;
};

/// Reads up to the end of the header. Throws Error(input).
PlyHeader read_ply_header(std::istream& file, const std::string& path);

}  // namespace defray
