#pragma once
// The commands of the program, one file each. Each adds itself to the command line and returns
// what to run when it was chosen: a function that gives the exit code.
#include <CLI/CLI.hpp>
#include <functional>

namespace defray::cli {

using Run = std::function<int()>;

Run add_render(CLI::App& app);
Run add_splat(CLI::App& app);
Run add_trade(CLI::App& app);
Run add_tune(CLI::App& app);
Run add_info(CLI::App& app);
Run add_devices(CLI::App& app);
Run add_scene(CLI::App& app);
Run add_compare(CLI::App& app);
Run add_sheet(CLI::App& app);
Run add_psf(CLI::App& app);
Run add_validate(CLI::App& app);

}  // namespace defray::cli
