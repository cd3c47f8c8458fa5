#pragma once
// What a launch of each kernel needs. Each kernel's row stands where it is launched, and nowhere
// else (`device/`); here they are found by name.
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace defray {

/// Work-items of a group; any other gives the same bits. `y` 0: a kernel of one dimension.
struct WorkGroup {
  std::size_t x, y;
};

/// On GPUs, of kernels of two dimensions. On an H200 what `defray tune` finds for single kernels
/// takes 0.7 to 1 of its time, and groups that suit CPUs 1.2 to 15 times (perf/notes/gpu.md).
inline constexpr WorkGroup gpu_group{4, 16};

struct Launch {
  /// Bytes of one plane, and of four channels, a surface.
  static constexpr std::size_t plane = 4, colour = 4 * plane;

  const char* kernel;
  /// On CPUs: over it `defray tune` gains little on PoCL's (perf/README.md).
  WorkGroup group;
  /// Rows around its own that a work-item looks at beyond what the CoC says.
  int reach_px = 0;
  /// Of planes that a kernel reads and writes, a surface of a window, on a device with memory of
  /// its own: of kernels that for_each_band launches.
  std::size_t bytes_a_surface = 0;
  /// Pixels of a row that a work-item takes, of the same kernels.
  std::size_t run_px = 1;
  /// Of planes that hold the band's own rows alone (Band::own), a pixel of these.
  std::size_t bytes_a_target = 0;
  /// Of the widest plane, a surface: a buffer holds it.
  std::size_t bytes_a_value = plane;
  /// Rows of a launch: enough to fill a device, few enough that a progress bar moves. 0: a band's.
  int rows_at_once = 0;
  /// It reads copies, whole runs of pixels with the columns in reach beside them: they take memory
  /// where the device works in host memory, too.
  bool reads_padded = false;

  WorkGroup group_on(bool gpu) const { return gpu && group.y > 0 ? gpu_group : group; }

  /// Values of a row of what it reads.
  std::size_t row_values(std::size_t width, std::int64_t reach) const {
    const std::size_t runs = (width + run_px - 1) / run_px;
    return reads_padded ? runs * run_px + 2 * static_cast<std::size_t>(reach) : width;
  }
};

/// Puts a kernel's row into the table, before main: one for each kernel, of the file's own.
struct LaunchRow {
  explicit LaunchRow(const Launch& launch);
};

/// Of all kernels, by name.
const std::vector<Launch>& launch_table();

/// Throws Error(internal) for a kernel that there is not.
const Launch& launch_of(const std::string& kernel);

}  // namespace defray
