#pragma once
// Words of the commands that defray prints.
#include <string>

namespace defray::cli {

/// As a shell takes it.
inline std::string shell_quoted(const std::string& text) {
  if (text.find_first_of(" '#*?$@&|;<>()\\\"`\n\t![]{}~") == std::string::npos) return text;
  std::string inside;
  for (const char c : text) inside += c == '\'' ? "'\\''" : std::string(1, c);
  return "'" + inside + "'";
}

}  // namespace defray::cli
