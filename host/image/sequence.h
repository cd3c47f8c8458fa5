#pragma once
// Frame sequences: patterns and ranges, in OpenImageIO's notation but for "####".
#include <string>
#include <vector>

namespace defray {

/// True where a name holds a frame pattern: "####" (a digit each; a single # is four), "@@",
/// "%04d". Throws Error(usage) on two patterns, or on more than 32 digits.
bool has_frame_pattern(const std::string& path);

/// Frame numbers of "1-8", "1-10x2", "1,5,9-12", each once; "1-10y2" are those that x2 leaves out.
/// Throws Error(usage) on anything else, and on more than a million.
std::vector<int> parse_frames(const std::string& text);

/// Numbers of the files that match a pattern, ascending. Throws Error(input) when none does.
std::vector<int> find_frames(const std::string& pattern);

/// What lies between ascending numbers that are not equally far apart, as "3 5-9"; at most five
/// gaps and "...".
std::string gaps_between(const std::vector<int>& frames);

/// The name of one frame; a name without a pattern stays as it is.
std::string frame_path(const std::string& pattern, int frame);

}  // namespace defray
