#include "base/pages.h"

#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>

namespace defray {

namespace {

/// For the pages that lie wholly within.
void advise(void* first, std::size_t bytes, int advice) {
  const auto page = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
  const auto at = reinterpret_cast<std::uintptr_t>(first);
  const std::uintptr_t begin = (at + page - 1) / page * page, end = (at + bytes) / page * page;
  if (begin < end) madvise(reinterpret_cast<void*>(begin), end - begin, advice);
}

}  // namespace

void give_back_pages(void* first, std::size_t bytes) { advise(first, bytes, MADV_DONTNEED); }

void prefer_large_pages([[maybe_unused]] void* first, [[maybe_unused]] std::size_t bytes) {
#ifdef MADV_HUGEPAGE
  constexpr std::size_t least = std::size_t{4} << 20;  // two pages, and what lies beside them
  if (bytes >= least) advise(first, bytes, MADV_HUGEPAGE);
#endif
}

}  // namespace defray
