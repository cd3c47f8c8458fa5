#pragma once
// Command lines that are refused before a command begins.
#include <CLI/CLI.hpp>
#include <string>

namespace defray::cli {

/// What is wrong, what is allowed and where to read more, in one line.
std::string explain_usage_error(const CLI::ParseError& error, const CLI::App& app);

/// Throws Error(usage) for an option of `command` whose value is empty or another option's name.
void refuse_no_values(const CLI::App& command);

}  // namespace defray::cli
