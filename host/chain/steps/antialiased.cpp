#include "chain/steps/antialiased.h"

#include <algorithm>

#include "base/parallel.h"
#include "base/plane.h"
#include "kernels/params.h"

namespace defray {
namespace {

// Chosen on the built-in scenes at 320x240 and 640x480, their depth anti-aliased or not, and on
// drawn ones: grass, rings, discs with rims, of plain colours and textures (perf/notes/edges.md).

/// Of mixed pixels one in so many is to be repaired at least, or none is: of anti-aliased depth one
/// in 3 to 15 lies between two surfaces (`cutout`, before nothing, one in 40).
constexpr std::size_t mixed_a_ramp = 20;

/// The share of colours that are means, in percent: 78 to 99 where depth was anti-aliased (65 to
/// 71: grass), 18 to 58 where as many pixels of sharp depth lay between (more where rims happen to
/// have their neighbours' mean). With 45 sharp grass would be repaired, with 75 anti-aliased grass
/// not.
constexpr std::size_t least_means_percent = 60;

/// Pixels count together in squares of three by three cells, to which so many come that are as
/// those of the whole frame. With squares of 96 px and 32 such pixels parts of `drift` and `plate2`
/// were not repaired; frames of which one half alone is anti-aliased are told apart either way.
constexpr std::size_t cell_px = 64;
constexpr std::size_t as_whole_frame = 128;

std::size_t cells_of(int px) { return (size(px) + cell_px - 1) / cell_px; }

}  // namespace

Antialiased::Antialiased(int width, int height)
    : width_(size(width)),
      columns_(cells_of(width)),
      rows_(cells_of(height)),
      cells_(columns_ * rows_) {}

std::size_t Antialiased::cell(std::size_t x, std::size_t y) const {
  return y / cell_px * columns_ + x / cell_px;
}

void Antialiased::add(Rows rows, std::span<const std::uint32_t> ramps) {
  if (rows.empty()) return;
  const std::size_t from = size(rows.y), end = size(rows.end), first = from / cell_px;
  const auto count = static_cast<int>((end + cell_px - 1) / cell_px - first);
  parallel_for(count, [&](int i) {  // rows of cells
    const std::size_t row = first + size(i);
    for (std::size_t y = std::max(from, row * cell_px); y < std::min(end, (row + 1) * cell_px);
         ++y) {
      for (std::size_t x = 0; x < width_; ++x) {
        const std::uint32_t ramp = ramps[y * width_ + x];
        if (ramp == 0) continue;
        Cell& own = cells_[cell(x, y)];
        ++own.ramps;
        own.means += (ramp & DEFRAY_RAMP_MIXES) != 0;
      }
    }
  });
}

/// A cell and those around it.
Antialiased::Cell Antialiased::around(std::size_t x, std::size_t y) const {
  Cell sum;
  for (std::size_t v = y > 0 ? y - 1 : 0; v < std::min(y + 2, rows_); ++v) {
    for (std::size_t u = x > 0 ? x - 1 : 0; u < std::min(x + 2, columns_); ++u) {
      sum.ramps += cells_[v * columns_ + u].ramps;
      sum.means += cells_[v * columns_ + u].means;
    }
  }
  return sum;
}

void Antialiased::decide(std::size_t mixed) {
  Cell all;
  for (const Cell& c : cells_) all.ramps += c.ramps, all.means += c.means;
  for (std::size_t y = 0; y < rows_; ++y) {
    for (std::size_t x = 0; x < columns_; ++x) {
      const Cell c = around(x, y);
      // (c.means + as_whole_frame * all.means / all.ramps) / (c.ramps + as_whole_frame), in percent
      Cell& own = cells_[y * columns_ + x];
      own.is_antialiased = 100 * (c.means * all.ramps + as_whole_frame * all.means) >=
                           least_means_percent * (c.ramps + as_whole_frame) * all.ramps;
      if (own.is_antialiased) pixels_ += own.ramps;
    }
  }
  if (pixels_ > 0 && pixels_ * mixed_a_ramp >= mixed) return;
  for (Cell& own : cells_) own.is_antialiased = false;
  pixels_ = 0;
}

}  // namespace defray
