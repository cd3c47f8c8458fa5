// The ray distribution buffers: from where rays end, by `rdb_gather`; from where they begin, where
// something is random, by `rdb_scatter`.
#include <algorithm>
#include <optional>

#include "base/parallel.h"
#include "device/device_backend.h"
#include "device/rdb_scatter.h"
#include "device/rdb_tiles.h"
#include "opencl/launch_table.h"
#include "rdb/light_sources.h"
#include "rdb/rdb_plan.h"
#include "rdb/segments.h"

namespace defray {
namespace {

const LaunchRow rdb_gather_launch({.kernel = "rdb_gather", .group = {1, 1}, .rows_at_once = 64});

/// Bytes of a pixel's winners where somebody asks for them.
std::size_t winner_bytes_of(const RayPlan& plan) {
  return plan.wants_nearest ? plan.lens.points.size() * sizeof(cl_uint) : 0;
}

/// Winners of so many bytes a compute unit stay in a CPU's caches from the kernel that writes them
/// to the one that reads them (1920x1080, spheres f2, two units: rays take 0.85 of the time of
/// bands of 64 rows, 130 MiB), and keep all units at work.
constexpr std::size_t winners_at_once = 8 << 20;

/// Rows of a band, whole tiles if it may be: winners of all its cells take a quarter of the memory
/// at most.
int rows_of_band(const Session& session, const Frame& frame, std::size_t winner_bytes) {
  const int rows_at_once = launch_of("rdb_gather").rows_at_once;
  if (winner_bytes == 0) return rows_at_once;
  const std::size_t row = size(frame.width) * winner_bytes;
  const std::size_t memory = session.memory_bytes() / 4;
  const std::size_t at_once = winners_at_once * session.info().compute_units;
  for (const int step : {DEFRAY_RAY_TILE, DEFRAY_RAY_ROWS}) {
    const std::size_t steps = row * size(step);
    if (memory < steps) continue;
    const auto count =
        static_cast<int>(std::max<std::size_t>(std::min(at_once, memory) / steps, 1));
    return std::min(count * step, rows_at_once);
  }
  return 1;
}

/// What RdbScatter computes, bit for bit, without jitter.
class RdbGather {
 public:
  /// All must stay alive and unchanged meanwhile.
  RdbGather(Session& session, const Frame& frame, const RayPlan& plan, KeptBuffer& winners);

  void run(RayResult& out, const Progress& progress);

 private:
  void gather(int y, int rows, RayResult& out);
  void gather_pass(int first_cell);
  void find_segments(int first_cell);

  Session& session_;
  const Frame& frame_;
  const LensPoints& lens_;
  RadiusBins bins_;
  std::size_t winner_bytes_;  ///< Of a pixel; 0: nobody wants winners.
  int rows_;                  ///< Most of a band.
  RayBuffers buffers_;
  RayTileWindow window_;
  BinSet sharp_;
  cl::Buffer filled_, segments_, first_, sharp_on_device_;
  std::optional<SegmentTable> table_;  ///< Of the last pass.
  int table_cell_ = -1;                ///< Its first.
};

RdbGather::RdbGather(Session& session, const Frame& frame, const RayPlan& plan, KeptBuffer& winners)
    : session_(session),
      frame_(frame),
      lens_(plan.lens),
      bins_(bins_of(frame)),
      winner_bytes_(winner_bytes_of(plan)),
      rows_(rows_of_band(session, frame, winner_bytes_)),
      buffers_(session, frame, plan, size(frame.width) * size(rows_), winner_bytes_, winners),
      window_(session, frame, plan, bins_),
      sharp_(sharp_bins(bins_, lens_)),
      filled_(session.buffer(size(frame.width) * size(rows_) * sizeof(cl_uint))),
      sharp_on_device_(session.view(&sharp_, sizeof sharp_)) {
  DefrayRaysParams& p = window_.params;
  const int margin = winner_bytes_ > 0 ? 0 : frame.margin;  // who asks for winners looks at all
  p.band_x = word(margin / DEFRAY_RAY_TILE * DEFRAY_RAY_TILE);
  p.band_end = word(frame.width - margin);
  p.wants_winners = plan.wants_nearest;
}

/// The table of the pass that begins with a cell: of one pass it stays.
void RdbGather::find_segments(int first_cell) {
  if (first_cell == table_cell_) return;
  session_.finish();  // kernels may look at the one before
  table_.emplace(lens_, first_cell, bins_, frame_.width, frame_.height,
                 session_.info().most_segments);
  table_cell_ = first_cell;
  first_ = session_.view(table_->first);
  segments_ = table_->segments.empty() ? first_ : session_.view(table_->segments);
}

void RdbGather::gather_pass(int first_cell) {
  find_segments(first_cell);
  DefrayRaysParams& p = window_.params;
  p.first_cell = word(first_cell);
  p.cell_count = word(table_->cell_count());
  p.is_first_pass = first_cell == 0;
  p.is_last_pass = p.first_cell + p.cell_count == lens_.points.size();
  const Lanes lanes(session_);
  const std::size_t strips_x = lanes.over_columns(p.band_end - p.band_x);
  session_.launch("rdb_gather", {strips_x, lanes.over_rows(p.band_rows)}, p, window_.keys,
                  window_.largest, window_.sending, window_.coverage, window_.channels, segments_,
                  first_, window_.reach, sharp_on_device_, window_.special_rows, window_.sparsity,
                  buffers_.lens, buffers_.rim_x, buffers_.rim_y, buffers_.winner, buffers_.means,
                  filled_, buffers_.seen);
}

void RdbGather::gather(int y, int rows, RayResult& out) {
  DefrayRaysParams& p = window_.params;
  p.band_y = word(y);
  p.band_rows = word(rows);
  const int cells = static_cast<int>(lens_.points.size());
  DefrayRdbParams r = buffers_.params();
  r.window_y = p.window_y;
  r.window_rows = p.window_rows;
  r.band_y = p.band_y;
  r.band_rows = p.band_rows;
  r.cell_count = word(cells);
  r.winner_words = 1;
  r.is_first_pass = r.is_last_pass = 1;
  buffers_.begin(r, out);
  for (int k = 0; k < cells; k += table_->cell_count()) gather_pass(k);
  buffers_.find_nearest(r, window_.planes);
  buffers_.read(r, out);
}

void RdbGather::run(RayResult& out, const Progress& progress) {
  const Rows wanted = frame_.wanted_rows();
  const int first = std::max(wanted.y, frame_.margin);
  const int end = std::min(wanted.end, frame_.height - frame_.margin);
  for (const BandRows& rows : window_.windows()) {
    const int from = std::max(rows.y, first), to = std::min(rows.y + rows.rows, end);
    if (from >= to) continue;
    window_.prepare(rows);
    // No strip lies across two tiles, and where there is room no tile across two bands.
    const int step = rows_ < DEFRAY_RAY_TILE ? std::min(rows_, DEFRAY_RAY_ROWS) : DEFRAY_RAY_TILE;
    for (int y = from / step * step; y < to; y += rows_) {
      const int last = std::min(y + rows_, to);
      gather(y, last - y, out);
      if (progress) progress(static_cast<double>(last - first) / (end - first));
    }
    window_.interpolate({from, to}, out);
  }
}

/// As rdb_gather leaves rows out.
void interpolate_scattered(Session& session, const Frame& frame, const RayPlan& plan,
                           RayResult& out) {
  if (plan.sparse_from[0] == 0) return;
  RayTileWindow window(session, frame, plan, bins_of(frame));
  for (const BandRows& rows : window.windows()) {
    window.prepare(rows);
    window.interpolate({rows.y, rows.y + rows.rows}, out);
  }
}

}  // namespace

RayResult DeviceBackend::rays(const Frame& frame, const RayPlan& plan, const LightSources* lights,
                              const Progress& progress) {
  const std::size_t pixels = size(frame.wanted_rows().count()) * size(frame.width);
  RayResult out{std::vector<Plane>(frame.channels.size()), {}};
  parallel_for(static_cast<int>(out.means.size()) + 1, [&](int c) {
    size(c) < out.means.size() ? out.means[size(c)].resize(pixels) : out.seen.resize(pixels);
  });
  if (plan.wants_nearest) out.nearest.resize(pixels);
  if (plan.by == RaysBy::gather && plan.lens.jitter == 0) {
    if (frame.wanted_rows().y == 0) winners_ = {};
    RdbGather(session_, frame, plan, winners_).run(out, progress);
    if (frame.wanted_rows().end == frame.height) winners_ = {};
  } else {
    RdbScatter(session_, frame, plan).run(out, progress);
    interpolate_scattered(session_, frame, plan, out);
  }
  if (lights && !lights->empty()) add_light(frame, plan, *lights, out);
  return out;
}

}  // namespace defray
