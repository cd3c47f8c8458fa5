#include "opencl/launch_table.h"

#include <algorithm>

#include "base/error.h"
#include "kernels/params.h"

namespace defray {
namespace {

// Bytes of planes, four channels each.
constexpr std::size_t plane = 4, colour = 4 * plane;

}  // namespace

const std::vector<Launch>& launch_table() {
  // Work-groups: what `defray tune` found no better than on PoCL's CPU device (perf/README.md).
  static const std::vector<Launch> table = {
      {"coc", 64, 0},
      // The first 3 pixels of what was found may be mixed; colours are looked at 4 times 4 px
      // further on; 1 for rounding.
      {"fill", 8, 1, 3 + 16 + 1, 3 * plane + colour + 2 * plane + colour, DEFRAY_RUN},
      {"gather_aware", 8, 1},
      {"gather_literal", 8, 1},
      {"gather_reach", 16, 1},
      {"gather_tiles", 16, 1},
      {"highlights", 64, 1, 0, 3 * plane + colour},
      {"highlights_add", 64, 1},
      {"linear_psf", 16, 1},
      {"mixed", 8, 1, 1, 2 * plane, DEFRAY_RUN},
      {"patterns_difference", 8, 1},
      // What matches are within reach of, and both surfaces.
      {"patterns_match", 8, 1, 0, 5 * plane + 2 * colour},
      {"rdb_clear", 256, 0},
      {"rdb_gather", 1, 1},
      // Cells take the most (rdb/rdb_plan.h); this says whether the frame stays on the device.
      {"rdb_merge", 64, 1, 1, 3 * plane + 2 * colour},
      {"rdb_nearest", 64, 1},
      {"rdb_pad", 64, 1},
      {"rdb_reach", 16, 1},
      {"rdb_scatter", 64, 1},
      {"rdb_tiles", 16, 1},
      // A ramp's ends are looked for two pixels away, and what is flat one further.
      {"repair", 8, 1, 3, 2 * plane, DEFRAY_RUN},
      {"soften", 2, 1, 1, 2 * plane + 2 * colour, DEFRAY_RUN},
      {"splat_project", 64, 0},
      {"splat_resolve", 1, 4},
      // A square of 7 px around. Two layers are written, the frame and what lies behind read.
      {"split", 64, 1, 3, 3 * plane + colour + (5 * plane + 2 * colour) / 2},
      {"tiltshift", 64, 1},
  };
  return table;
}

const Launch& launch_of(const std::string& kernel) {
  const auto& table = launch_table();
  const auto found =
      std::find_if(table.begin(), table.end(), [&](const Launch& l) { return kernel == l.kernel; });
  if (found == table.end())
    fail(ErrorKind::internal, "kernel '{}' is not in the launch table", kernel);
  return *found;
}

}  // namespace defray
