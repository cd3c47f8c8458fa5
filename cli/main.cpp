// Apart from the library of commands: tests have a main of their own.
#include <limits>

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "run.h"

namespace {

/// Planes of up to 32 MiB, the most that glibc allows, come from the memory that earlier ones left:
/// fresh pages for each were a tenth of a frame's time.
void keep_memory() {
#ifdef __GLIBC__
  mallopt(M_MMAP_THRESHOLD, 32 << 20);
  mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
#endif
}

}  // namespace

int main(int argc, char** argv) {
  keep_memory();
  return defray::cli::run(argc, argv);
}
