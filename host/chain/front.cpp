#include "chain/front.h"

#include <utility>

#include "base/parallel.h"
#include "chain/border.h"
#include "opencl/launch_table.h"

namespace defray {
namespace {

int repair_reach() { return launch_of("repair").reach_px; }
int mixed_reach() { return launch_of("mixed").reach_px; }

std::size_t first_of(const Frame& f, Rows rows) { return f.index(0, rows.y); }

}  // namespace

Front::Front(const Frame& picture, ChainWork& work)
    : frame(with_margin(picture, work.settings.border, work.report)),
      picture_(picture),
      work_(work),
      before_(frame.without_planes()) {
  frame.known_range = work.reach.seen;
}

/// Depth that was anti-aliased has many pixels between two surfaces: of the built-in scenes' edge
/// pixels one in 3 to 15, at 320 x 240 and larger (`cutout`, before nothing, one in 40). Otherwise
/// it is one in 28 or less: wires.
void Front::look_at_all() {
  std::size_t between = 0, between_in_picture = 0, edge = 0;
  for (int y = 0; y < frame.height; y += work_.bands.rows) {
    const Rows rows{y, std::min(frame.height, y + work_.bands.rows)};
    coc_to(rows.end + repair_reach());
    before_.wanted = rows;
    mixed = work_.backend.mixed(before_, std::move(mixed));
    const auto is_mixed = mixed.host();
    const std::size_t first = first_of(frame, rows), count = frame.index(0, rows.end) - first;
    edge += parallel_count(count, [&](std::size_t i) { return is_mixed[first + i] != 0; });
    work_.done("mixed");
    if (work_.settings.repair) {
      source_ = work_.backend.repair(before_, std::move(source_));
      const auto source = source_.host();
      const auto moves = [&](std::size_t i) { return source[first + i] != first + i; };
      between += parallel_count(count, moves);
      between_in_picture += parallel_count(
          count, [&](std::size_t i) { return moves(i) && !frame.is_in_margin(first + i); });
      work_.done("repair");
    }
    if (work_.is_banded) give_back_to(rows.end - repair_reach());
  }
  has_edges_ = edge > 0;
  constexpr std::size_t mixed_a_ramp = 20;
  is_antialiased_ = between * mixed_a_ramp >= edge && between > 0;
  if (is_antialiased_) work_.report.repaired = between_in_picture;
  is_decided_ = true;
  if (!is_antialiased_) frame.coc_quanta = std::exchange(before_.coc_quanta, {});
  if (work_.is_banded) return restart(0);
  (is_antialiased_ ? sources_done_ : mixed_done_) = frame.height;
}

void Front::coc_to(int end) {
  const Rows rows = go_on(coc_done_, end, frame.height);
  if (rows.empty()) return;
  const bool stays = is_decided_ && !is_antialiased_;
  repeat_coc(picture_, frame, rows, stays ? frame.coc_quanta : before_.coc_quanta);
  work_.done("border");
}

void Front::sources_to(int end) {
  const Rows rows = go_on(sources_done_, end, frame.height);
  if (rows.empty()) return;
  coc_to(rows.end + repair_reach());
  before_.wanted = rows;
  source_ = work_.backend.repair(before_, std::move(source_));
  work_.done("repair");
}

/// Gives pixels other ones' CoC, depth and data.
void Front::move_surfaces(Rows rows) {
  if (frame.coc_quanta.empty()) frame.coc_quanta = Quanta::room(frame.pixels());
  const auto source = source_.host();
  const auto before = before_.coc_quanta.host();
  const auto depth = picture_.depth.host();
  const auto coc = frame.coc_quanta.edit();
  const auto inverse = frame.inverse.edit();
  const bool has_data = !frame.data_of.empty();
  const auto data = has_data ? frame.data_of.edit() : std::span<std::uint32_t>{};
  parallel_for(rows.count(), [&](int row) {
    const std::size_t first = frame.index(0, rows.y + row);
    for (std::size_t i = first; i < first + size(frame.width); ++i) {
      const std::size_t from = source[i];
      coc[i] = before[from];
      if (from == i) continue;
      const std::size_t pixel = picture_pixel(frame, static_cast<int>(from % size(frame.width)),
                                              static_cast<int>(from / size(frame.width)));
      inverse[i] = inverse_of(depth[pixel]);
      if (has_data) data[i] = static_cast<std::uint32_t>(pixel);
    }
  });
}

void Front::surfaces_to(int end) {
  const Rows rows = go_on(surfaces_done_, end, frame.height);
  if (rows.empty()) return;
  if (is_antialiased_) {
    sources_to(rows.end);
  } else {
    coc_to(rows.end);
  }
  repeat_surfaces(picture_, work_.settings.border, work_.plan.wants_nearest, rows, frame);
  work_.done("border");
  if (!is_antialiased_) return;
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
  give_back(frame, rows, before_.coc_quanta);
  give_back(frame, rows, source_);
  give_back(frame, rows, frame.coc_quanta);
  give_back(frame, rows, frame.inverse);
  give_back(frame, rows, frame.channels);
  give_back(frame, rows, frame.data_of);
  give_back(frame, rows, mixed);
}

void Front::restart(int y) {
  give_back_to(frame.height);
  mixed_done_ = y;
  surfaces_done_ = sources_done_ = std::max(0, y - band_step);
  coc_done_ = kept_ = std::max(0, y - 2 * band_step);
}

}  // namespace defray
