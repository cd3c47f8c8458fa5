// Apart from the library of commands: tests have a main of their own.
#include "run.h"

int main(int argc, char** argv) { return defray::cli::run(argc, argv); }
