#pragma once
// What a launch of each kernel needs: the only place that says so.
#include <cstddef>
#include <string>
#include <vector>

namespace defray {

struct Launch {
  const char* kernel;
  /// Work-group; any other gives the same bits. `group_y` 0: a kernel of one dimension.
  std::size_t group_x, group_y;
  /// Rows around its own that a work-item looks at beyond what the CoC says.
  int reach_px = 0;
  /// Of planes that a kernel reads and writes, a surface, on a device with memory of its own: of
  /// kernels that for_each_band launches.
  std::size_t bytes_a_surface = 0;
  /// Pixels of a row that a work-item takes, of the same kernels.
  std::size_t run_px = 1;
};

/// Of all kernels, by name.
const std::vector<Launch>& launch_table();

/// Throws Error(device) for a kernel that there is not.
const Launch& launch_of(const std::string& kernel);

}  // namespace defray
