// Kernels `patterns_*`.
#include <algorithm>
#include <cstdlib>

#include "chain/patterns/patterns_cells.h"
#include "device/device_backend.h"
#include "opencl/bands.h"
#include "opencl/launch_table.h"

namespace defray {
namespace {

const LaunchRow patterns_difference_launch({.kernel = "patterns_difference", .group = {8, 1}});
// What matches are within reach of, and both surfaces.
const LaunchRow patterns_match_launch({.kernel = "patterns_match",
                                       .group = {8, 1},
                                       .bytes_a_surface = 5 * Launch::plane + 2 * Launch::colour});

/// Rows of cells at once, if the memory holds their differences: those of all shifts stay in the
/// cache from one kernel to the next.
constexpr int group_rows = 64;

DefrayPatternsParams params_of(const Frame& f, const std::vector<PatternShift>& shifts,
                               const PatternSettings& s) {
  DefrayPatternsParams p{};
  p.width = word(f.width);
  p.height = word(f.height);
  p.shift_count = word(static_cast<int>(shifts.size()));
  p.window_cells = s.window_cells;
  p.tolerance_quanta = static_cast<std::uint32_t>(s.tolerance_quanta);
  p.frame_pairs = frame_pairs(s.window_cells);
  p.channels = word(static_cast<int>(f.channels.size()));
  return p;
}

std::vector<DefrayPatternShift> on_device(const std::vector<PatternShift>& shifts) {
  std::vector<DefrayPatternShift> all;
  for (const PatternShift& s : shifts) all.push_back({s.x, s.y, s.parallel, s.frame_square});
  return all;
}

/// Rows around a pixel that its match and their windows lie in.
int reach_of(const std::vector<PatternShift>& shifts, const PatternSettings& settings) {
  int reach = 0;
  for (const PatternShift& s : shifts) reach = std::max(reach, std::abs(s.y));
  return reach + settings.window_cells * DEFRAY_PATTERN_CELL;
}

}  // namespace

Frame DeviceBackend::patterns(const Frame& f, Frame behind, const Words& pixels,
                              const Values<float>& variance,
                              const std::vector<PatternShift>& shifts,
                              const PatternSettings& settings) {
  if (shifts.empty()) return behind;
  DefrayPatternsParams p = params_of(f, shifts, settings);
  const int units = pattern_units(f.width), row_units = units * DEFRAY_PATTERN_UNIT;
  const int margin = settings.window_cells - 1;
  const std::size_t row_bytes = shifts.size() * pattern_row_words(f.width) * sizeof(std::uint32_t);
  const Words needed = needed_units(f, pixels, settings.window_cells);
  const std::vector<DefrayPatternShift> all = on_device(shifts);
  const cl::Buffer shift_buffer = session_.view(all);
  for_each_band(
      session_, "patterns_match", f, reach_of(shifts, settings),
      [&](Band& band) {
        const BandRows& rows = band.rows();
        const int cell_rows = pattern_rows(rows.rows);
        const int most = rows_that_fit(std::min(cell_rows, group_rows), session_.memory_bytes(),
                                       2 * size(margin) * row_bytes, row_bytes);
        const cl::Buffer cells = session_.buffer(size(most + 2 * margin) * row_bytes);
        const cl::Buffer words = band.in(pixels), coc = band.in(f.coc_quanta);
        const cl::Buffer behind_coc = band.in(behind.coc_quanta);
        const cl::Buffer behind_inverse = band.in(behind.inverse), inverse = band.in(f.inverse);
        const cl::Buffer is_needed = band.tiles(needed, units, DEFRAY_PATTERN_CELL);
        const cl::Buffer spread_buffer = band.tiles(variance, row_units, DEFRAY_PATTERN_CELL);
        const auto source = band.in(f.channels), target = band.in_out(behind.channels);
        p.height = word(rows.window_rows);
        for (const BandRows& group : cut_into_bands({0, cell_rows}, cell_rows, most, 0)) {
          p.first_row = rows.y - rows.window_y + (group.y - margin) * DEFRAY_PATTERN_CELL;
          p.cell_rows = word(group.rows + 2 * margin);
          session_.launch("patterns_difference",
                          {size(units + 2 * DEFRAY_PATTERN_MARGIN), p.cell_rows}, p, shift_buffer,
                          is_needed, words, coc, inverse, cells);
          session_.launch("patterns_match", {size(units), size(group.rows)}, p, shift_buffer, words,
                          coc, cells, spread_buffer, behind_coc, behind_inverse, source, target);
        }
        session_.finish();  // buffers are this function's own
        band.collect();
      },
      DEFRAY_PATTERN_CELL);
  return behind;
}

std::vector<std::uint32_t> DeviceBackend::patterns_difference(
    const Frame& f, const Words& pixels, const std::vector<PatternShift>& shifts,
    const PatternSettings& settings) {
  DefrayPatternsParams p = params_of(f, shifts, settings);
  const std::size_t rows = size(pattern_rows(f.height)), row = pattern_row_words(f.width);
  const std::size_t count = shifts.size() * rows * row;
  p.cell_rows = static_cast<std::uint32_t>(rows);
  const std::vector<DefrayPatternShift> all = on_device(shifts);
  const Words needed = needed_units(f, pixels, settings.window_cells);
  const cl::Buffer cells = session_.buffer(count * sizeof(std::uint32_t));
  session_.launch("patterns_difference", {row / DEFRAY_PATTERN_UNIT, rows}, p, session_.view(all),
                  session_.in(needed), session_.in(pixels), session_.in(f.coc_quanta),
                  session_.in(f.inverse), cells);
  std::vector<std::uint32_t> out(count);
  session_.read(cells, out.data(), count * sizeof(std::uint32_t));
  return out;
}

}  // namespace defray
