#include "base/memory.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <limits>
#include <sstream>

namespace defray {
namespace {

constexpr std::uint64_t unlimited = std::numeric_limits<std::uint64_t>::max();

/// What a file says in bytes; `max` is a word for none.
std::uint64_t limit_in(const std::filesystem::path& file) {
  std::uint64_t bytes = 0;
  return std::ifstream(file) >> bytes ? bytes : unlimited;
}

}  // namespace

std::uint64_t control_group_limit(const std::string& groups, const std::filesystem::path& tree) {
  std::uint64_t least = unlimited;
  std::istringstream lines(groups);
  for (std::string line; std::getline(lines, line);) {  // "0::/job/step" or "4:memory:/job/step"
    const bool is_unified = line.starts_with("0::");
    const std::size_t memory = line.find(":memory:");
    if (!is_unified && memory == std::string::npos) continue;
    const std::filesystem::path root = is_unified ? tree : tree / "memory";
    std::filesystem::path group = line.substr(is_unified ? 3 : memory + 8);
    for (;; group = group.parent_path()) {
      const std::filesystem::path folder = root / group.relative_path();
      least =
          std::min(least, limit_in(folder / (is_unified ? "memory.max" : "memory.limit_in_bytes")));
      if (!group.has_relative_path()) break;
    }
  }
  return least;
}

std::uint64_t usable_memory() {
  const std::uint64_t physical = static_cast<std::uint64_t>(sysconf(_SC_PHYS_PAGES)) *
                                 static_cast<std::uint64_t>(sysconf(_SC_PAGE_SIZE));
  rlimit addresses{};
  const bool is_known = getrlimit(RLIMIT_AS, &addresses) == 0;
  std::ifstream groups("/proc/self/cgroup");
  return std::min(
      {physical, is_known ? std::uint64_t{addresses.rlim_cur} : unlimited,
       control_group_limit({std::istreambuf_iterator<char>(groups), {}}, "/sys/fs/cgroup")});
}

}  // namespace defray
