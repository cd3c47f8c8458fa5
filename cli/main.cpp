// Apart from the library of commands: tests have a main of their own.
#include "keep_memory.h"
#include "run.h"

int main(int argc, char** argv) {
  defray::cli::keep_memory();
  return defray::cli::run(argc, argv);
}
