#include "chain/steps/front.h"

#include <utility>

#include "base/parallel.h"
#include "chain/steps/border.h"
#include "opencl/launch_table.h"

namespace defray {
namespace {

int mixed_reach() { return launch_of("mixed").reach_px; }

/// Where the surface lies that a pixel between two is nearer to.
std::size_t surface_of(const Frame& picture, std::size_t pixel, std::uint32_t ramp) {
  const int step = static_cast<int>(ramp & ~DEFRAY_RAMP_MIXES) - 1;
  const auto x = static_cast<int>(pixel % size(picture.width)) + step % 5 - 2;
  const auto y = static_cast<int>(pixel / size(picture.width)) + step / 5 - 2;
  return picture.index_within(x, y);
}

}  // namespace

Front::Front(const Frame& picture, ChainWork& work)
    : frame(with_margin(picture, work.settings.border, work.report)),
      picture_(picture),
      work_(work),
      antialiased_(picture.width, picture.height) {
  frame.known_range = work.reach.seen;
}

void Front::look_at_all() {
  const std::size_t mixed_count = count_mixed();
  has_edges_ = mixed_count > 0;
  if (work_.settings.repair) {
    look_for_ramps();
    antialiased_.decide(mixed_count);
    work_.report.repaired = antialiased_.pixels();
    is_repaired_ = antialiased_.pixels() > 0;
    work_.done("repair");
  }
  if (work_.is_banded) return restart(0);
  mixed_done_ = is_repaired_ ? 0 : frame.height;
}

/// Of depth as it is.
std::size_t Front::count_mixed() {
  std::size_t count = 0;
  for (int y = 0; y < frame.height; y += work_.bands.rows) {
    const Rows rows{y, std::min(frame.height, y + work_.bands.rows)};
    coc_to(rows.end + mixed_reach());
    frame.wanted = rows;
    mixed = work_.backend.mixed(frame, std::move(mixed));
    const auto is_mixed = mixed.host();
    const std::size_t first = frame.index(0, rows.y);
    count += parallel_count(frame.index(0, rows.end) - first,
                            [&](std::size_t i) { return is_mixed[first + i] != 0; });
    work_.done("mixed");
    if (work_.is_banded) give_back_to(rows.end - mixed_reach());
  }
  return count;
}

void Front::look_for_ramps() {
  for (int y = 0; y < picture_.height; y += work_.bands.rows) {
    const Rows rows{y, std::min(picture_.height, y + work_.bands.rows)};
    ramps_to(rows.end);
    antialiased_.add(rows, ramps_.host());
    if (work_.is_banded) give_back(picture_, rows, ramps_);
  }
}

void Front::coc_to(int end) {
  const Rows rows = go_on(coc_done_, end, frame.height);
  if (rows.empty()) return;
  repeat_coc(picture_, frame, rows, frame.coc_quanta);
  work_.done("border");
}

void Front::ramps_to(int end) {
  Frame picture = picture_;
  const Rows rows = go_on(ramps_done_, end, picture.height);
  if (rows.empty()) return;
  picture.wanted = rows;
  ramps_ = work_.backend.repair(picture, std::move(ramps_));
  work_.done("repair");
}

/// Gives pixels other ones' CoC, depth and data.
void Front::move_surfaces(Rows rows) {
  const auto ramps = ramps_.host();
  const auto seen = picture_.coc_quanta.host();
  const auto depth = picture_.depth.host();
  const auto coc = frame.coc_quanta.edit();
  const auto inverse = frame.inverse.edit();
  const bool has_data = !frame.data_of.empty();
  const auto data = has_data ? frame.data_of.edit() : std::span<std::uint32_t>{};
  parallel_for(rows.count(), [&](int row) {
    for (int x = 0; x < frame.width; ++x) {
      const std::size_t pixel = picture_pixel(frame, x, rows.y + row);
      if (ramps[pixel] == 0 ||
          !antialiased_.is_at(pixel % size(picture_.width), pixel / size(picture_.width)))
        continue;
      const std::size_t i = frame.index(x, rows.y + row);
      const std::size_t from = surface_of(picture_, pixel, ramps[pixel]);
      coc[i] = seen[from];
      inverse[i] = inverse_of(depth[from]);
      if (has_data) data[i] = static_cast<std::uint32_t>(from);
    }
  });
}

void Front::surfaces_to(int end) {
  const Rows rows = go_on(surfaces_done_, end, frame.height);
  if (rows.empty()) return;
  coc_to(rows.end);
  repeat_surfaces(picture_, work_.settings.border, work_.plan.wants_nearest, rows, frame);
  work_.done("border");
  if (!is_repaired_) return;
  ramps_to(rows.end - frame.margin);
  move_surfaces(rows);
  work_.done("repair");
}

void Front::to(int end) {
  surfaces_to(end + mixed_reach());
  const Rows rows = go_on(mixed_done_, end, frame.height);
  if (rows.empty()) return;
  surfaces_to(rows.end + mixed_reach());
  frame.wanted = rows;
  mixed = work_.backend.mixed(frame, std::move(mixed));
  work_.done("mixed");
}

void Front::give_back_to(int end) {
  const Rows rows = not_needed(kept_, end);
  give_back(frame, rows, frame.coc_quanta);
  give_back(frame, rows, frame.inverse);
  give_back(frame, rows, frame.channels);
  give_back(frame, rows, frame.data_of);
  give_back(frame, rows, mixed);
  // The margin below goes on with the last row.
  const int of_picture = std::min(end - frame.margin, picture_.height - 1);
  give_back(picture_, not_needed(ramps_kept_, of_picture), ramps_);
}

void Front::restart(int y) {
  give_back_to(frame.height);
  const int before = std::max(0, y - band_step);
  mixed_done_ = y;
  coc_done_ = surfaces_done_ = kept_ = before;
  ramps_done_ = ramps_kept_ = std::max(0, before - frame.margin) / band_step * band_step;
}

}  // namespace defray
