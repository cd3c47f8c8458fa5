#pragma once
// How much memory there is.
#include <cstdint>
#include <filesystem>
#include <string>

namespace defray {

/// Bytes that this process may use at most: the machine's memory, or what a limit on its addresses
/// (ulimit -v) or a control group (of a batch system or container) leaves of it.
std::uint64_t usable_memory();

/// The least limit of a process's memory control groups and those that these are in. `groups`: its
/// /proc/PID/cgroup; `tree`: where control groups are, version 2's, or 1's with a folder `memory`.
std::uint64_t control_group_limit(const std::string& groups, const std::filesystem::path& tree);

}  // namespace defray
