// What a file says of itself.
#include <algorithm>
#include <charconv>

#include "image/image_file_part.h"

namespace defray {
namespace {

using OIIO::ParamValue;
using OIIO::TypeDesc;

template <typename T>
double first_as(const ParamValue& value) {
  return static_cast<double>(*static_cast<const T*>(value.data()));
}

/// The number at the front of a text, "50.00 mm".
std::optional<double> number_of(const std::string& text) {
  const char* begin = text.data() + std::min(text.find_first_not_of(' '), text.size());
  double number = 0;
  const auto [end, error] = std::from_chars(begin, text.data() + text.size(), number);
  if (error != std::errc() || end == begin) return std::nullopt;
  return number;
}

}  // namespace

std::optional<double> number_of(const ParamValue& value) {
  if (value.type() == OIIO::TypeRational) {
    const int* parts = static_cast<const int*>(value.data());
    if (parts[1] == 0) return std::nullopt;
    return static_cast<double>(parts[0]) / parts[1];
  }
  switch (value.type().basetype) {
    case TypeDesc::STRING:
      return number_of(value.get_string());
    case TypeDesc::UINT8:
      return first_as<std::uint8_t>(value);
    case TypeDesc::INT8:
      return first_as<std::int8_t>(value);
    case TypeDesc::UINT16:
      return first_as<std::uint16_t>(value);
    case TypeDesc::INT16:
      return first_as<std::int16_t>(value);
    case TypeDesc::UINT32:
      return first_as<std::uint32_t>(value);
    case TypeDesc::INT32:
      return first_as<std::int32_t>(value);
    case TypeDesc::UINT64:
      return first_as<std::uint64_t>(value);
    case TypeDesc::INT64:
      return first_as<std::int64_t>(value);
    case TypeDesc::HALF:
      return static_cast<double>(value.get_float());
    case TypeDesc::FLOAT:
      return first_as<float>(value);
    case TypeDesc::DOUBLE:
      return first_as<double>(value);
    default:
      return std::nullopt;
  }
}

std::optional<double> ImageFile::metadata_number(const std::string& name) const {
  for (const Part& part : parts_) {
    const ParamValue* value = part.spec.find_attribute(name);
    if (!value) continue;
    if (const auto number = number_of(*value)) return number;
  }
  return std::nullopt;
}

std::optional<Matrix4> ImageFile::metadata_matrix(const std::string& name) const {
  for (const Part& part : parts_) {
    const ParamValue* value = part.spec.find_attribute(name);
    if (!value || value->type() != OIIO::TypeMatrix44) continue;
    Matrix4 matrix;
    std::copy_n(static_cast<const float*>(value->data()), matrix.size(), matrix.begin());
    return matrix;
  }
  return std::nullopt;
}

std::optional<std::string> ImageFile::metadata_text(const std::string& name) const {
  for (const Part& part : parts_) {
    if (const ParamValue* value = part.spec.find_attribute(name)) return value->get_string();
  }
  return std::nullopt;
}

std::optional<std::string> ImageFile::metadata_name(const std::string& name) const {
  for (const Part& part : parts_) {
    if (const ParamValue* value = part.spec.find_attribute(name)) return value->name().string();
  }
  return std::nullopt;
}

}  // namespace defray
