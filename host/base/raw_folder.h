#pragma once
// Folders by system calls alone: what a signal handler may look at.
#include <sys/syscall.h>
#include <unistd.h>

#include <cstdint>

namespace defray {

/// Calls use(name) for what is in an open folder; readdir may not be called from a handler.
template <typename Use>
void for_each_name(int folder, const Use& use) noexcept {
  struct Entry {  // as the system gives them
    std::uint64_t number, offset;
    unsigned short size;
    unsigned char type;
    char name[1];
  };
  alignas(Entry) char entries[4096];
  long count = 0;
  while ((count = syscall(SYS_getdents64, folder, entries, sizeof entries)) > 0) {
    for (long at = 0; at < count;) {
      const auto* entry = reinterpret_cast<const Entry*>(entries + at);
      at += entry->size;
      const char* name = entry->name;
      const bool is_dots = name[0] == '.' && (!name[1] || (name[1] == '.' && !name[2]));
      if (!is_dots) use(name);
    }
  }
}

}  // namespace defray
