#include "opencl/launch_table.h"

#include <algorithm>
#include <string_view>

#include "base/error.h"

namespace defray {
namespace {

/// A function's, as rows of other files may come before anything of this one.
std::vector<Launch>& table_rows() {
  static std::vector<Launch> table;
  return table;
}

}  // namespace

LaunchRow::LaunchRow(const Launch& launch) {
  const auto place = std::find_if(
      table_rows().begin(), table_rows().end(),
      [&](const Launch& other) { return std::string_view(launch.kernel) < other.kernel; });
  table_rows().insert(place, launch);
}

const std::vector<Launch>& launch_table() { return table_rows(); }

const Launch& launch_of(const std::string& kernel) {
  const auto& table = launch_table();
  const auto found =
      std::find_if(table.begin(), table.end(), [&](const Launch& l) { return kernel == l.kernel; });
  if (found == table.end())
    fail(ErrorKind::internal, "kernel '{}' is not in the launch table", kernel);
  return *found;
}

}  // namespace defray
