#include "rdb/rdb_plan.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/plane.h"
#include "kernels/params.h"
#include "opencl/launch_table.h"

namespace defray {
namespace {

/// A pass that stays in the last-level cache scatters twice as fast as one that does not; below a
/// band height of a few reaches, rows that two bands share cost more than that.
constexpr std::size_t pass_bytes_in_cache = std::size_t{16} << 20;

double mib(std::size_t bytes) { return static_cast<double>(bytes) / (1 << 20); }

}  // namespace

int rdb_reach(std::int32_t largest_coc_quanta) {
  // |u| <= 1 for every ray that counts, and a ray lands within half a pixel of p + r u.
  return (largest_coc_quanta >> DEFRAY_COC_FRACTION_BITS) + 1;
}

int span_rows(const RayPlan& plan) { return plan.has_spans ? 2 : 0; }

std::size_t rdb_bytes_a_pixel(std::size_t cells) {
  return cells * sizeof(RdbWinner) + launch_of("rdb_merge").bytes_a_target;
}

std::vector<RdbPass> plan_rdb_passes(int width, Rows wanted, int height, int cell_count, int reach,
                                     std::size_t memory_bytes) {
  const std::size_t row_bytes = size(width) * rdb_bytes_a_pixel(1);
  if (memory_bytes < row_bytes) {
    fail(ErrorKind::usage, "{} is {:.4g} MiB: one row of {} pixels needs at least {:.3f} MiB",
         field("memory"), mib(memory_bytes), width, std::ceil(mib(row_bytes) * 1000) / 1000);
  }
  const std::size_t tall_enough = 4 * static_cast<std::size_t>(reach);
  const std::size_t rows_wanted = std::max(pass_bytes_in_cache / row_bytes, tall_enough);
  const int rows = static_cast<int>(
      std::min(size(rows_that_fit(wanted.count(), memory_bytes, 0, row_bytes)), rows_wanted));
  const std::size_t band = static_cast<std::size_t>(width) * static_cast<std::size_t>(rows);
  const std::size_t pass_bytes = std::max(std::min(memory_bytes, pass_bytes_in_cache),
                                          row_bytes * static_cast<std::size_t>(rows));
  const std::size_t for_cells = pass_bytes - band * rdb_bytes_a_pixel(0);
  const int cells = static_cast<int>(std::min<std::size_t>(static_cast<std::size_t>(cell_count),
                                                           for_cells / (band * sizeof(RdbWinner))));
  std::vector<RdbPass> passes;
  for (const BandRows& of_band : cut_into_bands(wanted, height, rows, reach)) {
    for (int k = 0; k < cell_count; k += cells) {
      passes.push_back({of_band, k, std::min(cells, cell_count - k)});
    }
  }
  return passes;
}

}  // namespace defray
