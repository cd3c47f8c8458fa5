#pragma once
// Option values that are more than a number or a word of a list.
#include <array>
#include <cstddef>
#include <string>

namespace defray::cli {

/// "cm" or "0.01" -> 0.01, metres in a scene unit. Throws Error(usage).
double parse_unit(const std::string& text);

/// The stored depth that says "background"; infinity, and so no other, for "none". Throws
/// Error(usage).
double parse_background(const std::string& text);

/// "64x1" -> {64, 1}; {0, 0} for an empty text. Throws Error(usage).
std::array<std::size_t, 2> parse_work_group(const std::string& text);

}  // namespace defray::cli
