#pragma once
// Option values that are more than a number or a word of a list.
#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "defray/io.h"

namespace defray::cli {

/// "cm" or "0.01" -> 0.01, metres in a scene unit. Throws Error(usage).
double parse_unit(const std::string& text);

/// 0.01 -> "cm"; "0.5" where no unit is so long.
std::string unit_of(double metres);

/// The stored depth that says "background"; infinity, and so no other, for "none". Throws
/// Error(usage).
double parse_background(const std::string& text);

/// "3840x2160+100+50" -> width, height, x and y. Throws Error(usage).
Window parse_window(const std::string& option, const std::string& text,
                    bool may_be_left_of_0 = false);

/// "512x512" -> width and height. Throws Error(usage).
Window parse_size(const std::string& option, const std::string& text);

/// "640,360" -> that pixel. Throws Error(usage).
PixelPlace parse_place(const std::string& option, const std::string& text);

/// "1,2.5,-3" -> three finite numbers. Throws Error(usage).
std::array<double, 3> parse_point(const std::string& option, const std::string& text);

/// "90", "90s", "10m", "1h" -> seconds, above 0. Throws Error(usage).
double parse_seconds(const std::string& option, const std::string& text);

/// A work-group for one kernel, or for all that no other names.
struct WorkGroup {
  std::string kernel;  ///< Empty: all.
  std::size_t x = 0, y = 1;
};

/// "64x1", "fill=8x8,rdb_merge=32" -> a work-group each, that of all kernels first. Throws
/// Error(usage).
std::vector<WorkGroup> parse_work_groups(const std::string& text);

}  // namespace defray::cli
