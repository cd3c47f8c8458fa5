#include "opencl/kernel_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <regex>
#include <set>
#include <sstream>
#include <string_view>

#include "base/error.h"
#include "kernels/kernel_files.h"

namespace defray {
namespace {

const KernelFile& file_of(std::string_view name) {
  const auto found =
      std::find_if(std::begin(kernel_files), std::end(kernel_files),
                   [&](const KernelFile& file) { return std::string_view(file.name) == name; });
  if (found == std::end(kernel_files)) fail(ErrorKind::internal, "no kernel file '{}'", name);
  return *found;
}

std::vector<std::string> all_kernels() {
  std::vector<std::string> names;
  for (const KernelFile& file : kernel_files) {
    if (std::string_view(file.name).ends_with(".cl")) names.push_back(file.name);
  }
  return names;
}

/// NAME of a line `#include "NAME"`, or an empty string.
std::string_view included_by(std::string_view line) {
  constexpr std::string_view directive = "#include \"";
  if (!line.starts_with(directive)) return {};
  line.remove_prefix(directive.size());
  return line.substr(0, line.find('"'));
}

/// Appends a file to the program, includes in their places, unless it is there already.
void append(std::string& program, std::string_view name, std::set<std::string_view>& done) {
  const KernelFile& file = file_of(name);
  if (!done.insert(file.name).second) return;
  program += fmt::format("#line 1 \"kernels/{}\"\n", file.name);
  std::string_view rest = file.text;
  for (int number = 1; !rest.empty(); ++number) {
    const std::string_view line = rest.substr(0, rest.find('\n'));
    rest.remove_prefix(std::min(line.size() + 1, rest.size()));
    if (const std::string_view included = included_by(line); !included.empty()) {
      append(program, included, done);
      program += fmt::format("#line {} \"kernels/{}\"\n", number + 1, file.name);
    } else {
      program.append(line) += '\n';
    }
  }
}

void substitute(std::string& text, const Substitution& substitution) {
  const auto& [from, to, everywhere] = substitution;
  std::size_t count = 0;
  for (auto at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
    ++count;
  }
  if (count == 0 || (count > 1 && !everywhere)) {
    fail(ErrorKind::internal, "'{}' is {} times in the kernels", from, count);
  }
}

/// "kernels/FILE:LINE" of a line of the program, both counted from 1.
std::string place_of(const std::string& program, int line) {
  std::string file, text;
  int number = 0;
  std::istringstream lines(program);
  for (int i = 0; i < line && std::getline(lines, text); ++i) {
    std::smatch directive;
    static const std::regex pattern("#line ([0-9]+) \"(.*)\"");
    if (std::regex_match(text, directive, pattern)) {
      number = std::stoi(directive[1]) - 1;
      file = directive[2];
    } else {
      ++number;
    }
  }
  return fmt::format("{}:{}", file, number);
}

}  // namespace

std::string kernel_source(const std::vector<std::string>& names,
                          const std::vector<Substitution>& substitutions) {
  std::string program;
  std::set<std::string_view> done;
  for (const std::string& name : names.empty() ? all_kernels() : names) {
    append(program, name, done);
  }
  for (const Substitution& substitution : substitutions) substitute(program, substitution);
  return program;
}

std::string with_places(std::string log, const std::string& program) {
  static const std::regex counted("(?:<kernel>|input\\.cl):([0-9]{1,9})(?=:)");
  std::smatch found;
  while (std::regex_search(log, found, counted)) {
    const std::string place = place_of(program, std::stoi(found[1]));
    log.replace(static_cast<std::size_t>(found.position()),
                static_cast<std::size_t>(found.length()), place);
  }
  return log;
}

}  // namespace defray
