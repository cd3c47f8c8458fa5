#pragma once
// Help as a terminal is wide, and `defray help COMMAND`.
#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

namespace defray::cli {

/// Lines of at most `width` characters, broken at spaces; a longer word stays whole.
std::string wrapped(const std::string& text, std::size_t width);

/// On a terminal texts are wrapped where it ends. Elsewhere each is one line, for grep.
std::shared_ptr<CLI::Formatter> help_format();

/// What main was given less the program's name, with `help` and `help COMMAND` as `--help` and
/// `COMMAND --help`; in the order in which CLI::App::parse takes them: the last first.
std::vector<std::string> arguments_of(int argc, char** argv, const CLI::App& app);

}  // namespace defray::cli
