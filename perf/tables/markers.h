#pragma once
// Places in a README that a program writes: what stands between the lines "<!-- NAME:begin -->" and
// "<!-- NAME:end -->".
#include <string>
#include <vector>

namespace defray::perf {

/// Names of all marked places, in order. Throws Error(input), naming `path`, on a marker without
/// its partner, and where a name stands twice.
std::vector<std::string> marked_names(const std::string& text, const std::string& path);

/// The text with this content (lines) between the name's markers; every other byte stays. Throws
/// Error(input), naming `path`, where there are none.
std::string with_marked(const std::string& text, const std::string& path, const std::string& name,
                        const std::string& content);

}  // namespace defray::perf
