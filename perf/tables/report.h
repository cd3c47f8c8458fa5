#pragma once
// defray-perf report: writes tables of figures into a README.
#include <CLI/CLI.hpp>
#include <functional>

namespace defray::perf {

/// Adds the command; the result runs it.
std::function<int()> add_report(CLI::App& app);

}  // namespace defray::perf
