// Kernel `patterns_agree`.
#include <algorithm>
#include <cstdlib>

#include "chain/patterns/patterns.h"
#include "device/device_backend.h"
#include "opencl/bands.h"
#include "opencl/launch_table.h"

namespace defray {
namespace {

const LaunchRow patterns_agree_launch({.kernel = "patterns_agree",
                                       .group = {1, 1},
                                       .bytes_a_surface = 2 * Launch::plane});

/// Rows that a work-item compares: a part of a picture's, so that there is work for all of a GPU.
constexpr int compared_rows = 16;

int rows_of_part(int width, int row_step) {
  const int runs = (width + DEFRAY_RUN - 1) / DEFRAY_RUN;
  return row_step * std::clamp(DEFRAY_AGREE_RUNS / runs, 1, compared_rows);
}

std::int64_t reach_of_shifts(const std::vector<DefrayPatternShift>& shifts) {
  int reach = 0;
  for (const DefrayPatternShift& s : shifts) reach = std::max(reach, std::abs(s.y));
  return reach;
}

}  // namespace

std::vector<DefrayAgreement> DeviceBackend::patterns_agree(
    const Frame& f, const Words& pixels, const std::vector<DefrayPatternShift>& shifts,
    int row_step, std::int32_t tolerance_quanta) {
  std::vector<DefrayAgreement> all(shifts.size());
  if (shifts.empty() || f.pixels() == 0) return all;
  const cl::Buffer shift_buffer = session_.view(shifts);
  for_each_band(session_, "patterns_agree", f, reach_of_shifts(shifts), [&](Band& band) {
    const BandRows& rows = band.rows();
    DefrayAgreeParams p{};
    p.width = word(f.width);
    p.height = word(rows.window_rows);
    p.above = rows.window_y;
    p.first_row = rows.y - rows.window_y;
    p.end_row = p.first_row + rows.rows;
    p.part_rows = rows_of_part(f.width, row_step);
    p.row_step = row_step;
    p.shift_count = word(static_cast<int>(shifts.size()));
    p.tolerance_quanta = tolerance_quanta;
    const std::size_t parts = size((rows.rows + p.part_rows - 1) / p.part_rows);
    const std::size_t count = parts * shifts.size();
    const cl::Buffer sums = session_.buffer(count * sizeof(DefrayAgreement));
    session_.launch("patterns_agree", {shifts.size(), parts}, p, shift_buffer, band.in(pixels),
                    band.in(f.coc_quanta), sums);
    session_.look_at<DefrayAgreement>(sums, count, [&](std::span<const DefrayAgreement> made) {
      for (std::size_t i = 0; i < count; ++i) {
        all[i % shifts.size()].squares += made[i].squares;
        all[i % shifts.size()].pairs += made[i].pairs;
      }
    });
  });
  return all;
}

}  // namespace defray
