// Which functions a test reaches: `mutate.sh` runs for a mutant the tests that reach its function.
//
// Clang's -fsanitize-coverage=func,trace-pc-guard,pc-table calls the first function below where
// each function of the project begins. In the folder $DEFRAY_REACHED lie for every program NAME
//   NAME.flags    a byte a function, shared by all processes: forks, and programs that tests start
//   NAME.places   where the functions begin in the program, 8 bytes each
// and TESTS, lines "program test milliseconds NAME:index NAME:index ...". Without $DEFRAY_REACHED
// nothing is done.
#include "reached.h"

#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string>

namespace {

unsigned char* flags_here = nullptr;  ///< A byte for each function of this program.
std::uint32_t count_here = 0;

std::string folder() {
  const char* set = std::getenv("DEFRAY_REACHED");
  return set ? set : "";
}

unsigned char* shared_bytes(const std::string& path, std::size_t count) {
  const int file = open(path.c_str(), O_RDWR | O_CREAT, 0600);
  if (file < 0 || ftruncate(file, static_cast<off_t>(count)) != 0) std::abort();
  void* bytes = mmap(nullptr, count, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  close(file);
  if (bytes == MAP_FAILED) std::abort();
  return static_cast<unsigned char*>(bytes);
}

/// Of all programs that the tests of a folder have started.
template <typename Look>
void for_each_flags(const Look& look) {
  for (const auto& file : std::filesystem::directory_iterator(folder())) {
    if (file.path().extension() != ".flags") continue;
    const std::size_t count = file.file_size();
    unsigned char* flags = shared_bytes(file.path(), count);
    look(file.path().stem().string(), flags, count);
    munmap(flags, count);
  }
}

/// This program's file of a kind.
std::string file_here(const char* kind) {
  return folder() + "/" + program_invocation_short_name + kind;
}

}  // namespace

extern "C" {

void __sanitizer_cov_trace_pc_guard(const std::uint32_t* guard) {
  if (*guard != 0) flags_here[*guard - 1] = 1;
}

void __sanitizer_cov_trace_pc_guard_init(std::uint32_t* begin, const std::uint32_t* end) {
  if (begin == end || *begin != 0 || folder().empty()) return;
  count_here = static_cast<std::uint32_t>(end - begin);
  flags_here = shared_bytes(file_here(".flags"), count_here);
  for (std::uint32_t i = 0; i < count_here; ++i) begin[i] = i + 1;
}

/// Pairs (address, kind) in the order of the guards.
void __sanitizer_cov_pcs_init(const std::uintptr_t* begin, const std::uintptr_t*) {
  Dl_info info;
  if (count_here == 0 || dladdr(begin, &info) == 0) return;
  const auto base = reinterpret_cast<std::uintptr_t>(info.dli_fbase);
  unsigned char* places = shared_bytes(file_here(".places"), 8 * std::size_t{count_here});
  for (std::uint32_t i = 0; i < count_here; ++i) {
    const std::uint64_t place = begin[2 * i] - base;
    std::memcpy(places + 8 * std::size_t{i}, &place, 8);
  }
  munmap(places, 8 * std::size_t{count_here});
}

}  // extern "C"

namespace defray::test {

void clear_reached() {
  for_each_flags([](const std::string&, unsigned char* flags, std::size_t count) {
    std::memset(flags, 0, count);
  });
}

std::string reached() {
  std::string text;
  for_each_flags([&](const std::string& name, const unsigned char* flags, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      if (flags[i] != 0) text += " " + name + ":" + std::to_string(i);
    }
  });
  return text;
}

}  // namespace defray::test
