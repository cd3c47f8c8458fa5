#pragma once
// Small text helpers that the standard library lacks.
#include <string>
#include <vector>

namespace defray {

std::string lower_case(std::string text);
/// "a/B.PNG" -> ".png".
std::string lower_extension(const std::string& path);
bool contains_ignoring_case(const std::string& text, const std::string& part);

/// "a.b.c" -> {a, b, c}.
std::vector<std::string> split(const std::string& text, char separator);
std::string join(const std::vector<std::string>& parts, const std::string& separator);

/// The candidate nearest in spelling to `word` (Damerau-Levenshtein over the word's third at the
/// most), or an empty string.
std::string nearest_spelling(const std::string& word, const std::vector<std::string>& candidates);

/// " Did you mean 'x'?", or an empty string when nothing is near.
std::string did_you_mean(const std::string& word, const std::vector<std::string>& candidates);

/// "WHAT 'x' is not known. Did you mean 'y'? Allowed: y z".
std::string not_known(const std::string& what, const std::string& word,
                      const std::vector<std::string>& allowed);

}  // namespace defray
