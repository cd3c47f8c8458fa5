#pragma once
// What both programs ask of the C library before anything else.
#include <limits>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace defray::cli {

/// Planes of up to 32 MiB, the most that glibc allows, come from the memory that earlier ones left:
/// fresh pages for each were a tenth of a frame's time.
inline void keep_memory() {
#ifdef __GLIBC__
  mallopt(M_MMAP_THRESHOLD, 32 << 20);
  mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
#endif
}

}  // namespace defray::cli
