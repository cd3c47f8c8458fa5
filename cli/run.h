#pragma once

namespace defray::cli {

/// The whole program but its main: reads the command line, runs one command, gives the exit code.
int run(int argc, char** argv);

}  // namespace defray::cli
