#include "device/rays_gather.h"

#include <algorithm>

#include "lens/coc.h"
#include "rdb/rdb_plan.h"

namespace defray {
namespace {

constexpr int rows_at_once = 256;  ///< Of a launch, for the progress bar.

using BinSet = std::array<std::uint64_t, DEFRAY_RAY_WORDS>;

template <typename Holds>
BinSet bins_that(const Holds& holds) {
  BinSet set{};
  for (int b = 0; b < DEFRAY_RAY_BINS; ++b) {
    if (holds(b)) set[size(b / 64)] |= std::uint64_t{1} << (b % 64);
  }
  return set;
}

/// Bins that reach from so many tiles away: pixels of other tiles are as far apart at least.
std::vector<BinSet> bins_by_distance(const RadiusBins& bins, int tiles) {
  std::vector<BinSet> near;
  for (int away = 0; away <= tiles; ++away) {
    const std::int64_t gap_px = std::max(away - 1, 0) * std::int64_t{DEFRAY_RAY_TILE};
    near.push_back(bins_that(
        [&](int b) { return (bins.largest_of(b) >> DEFRAY_COC_FRACTION_BITS) + 1 >= gap_px; }));
  }
  return near;
}

/// Rows of a band; winners of all its cells, where somebody wants them, take half the memory.
int rows_of_band(const Session& session, const Frame& frame, std::size_t winner_cells) {
  if (winner_cells == 0) return rows_at_once;
  const std::size_t row = size(frame.width) * winner_cells * sizeof(RdbWinner);
  const auto rows = std::min<std::size_t>(session.memory_bytes() / 2 / row, rows_at_once);
  return rows < DEFRAY_RAY_ROWS ? 1 : static_cast<int>(rows / DEFRAY_RAY_ROWS * DEFRAY_RAY_ROWS);
}

int in_tiles(int pixels) { return (pixels + DEFRAY_RAY_TILE - 1) / DEFRAY_RAY_TILE; }

}  // namespace

RaysGather::RaysGather(Session& session, const Frame& frame, const RayPlan& plan,
                       const RadiusBins& bins, const SegmentTable& table,
                       const LightSources* lights)
    : session_(session),
      frame_(frame),
      reach_px_(std::min(rdb_reach(std::max(std::abs(bins.least), std::abs(bins.largest))),
                         std::max(frame.width, frame.height))),
      winner_cells_(plan.wants_nearest || (lights && !lights->empty()) ? plan.cells.centres.size()
                                                                       : 0),
      rows_(rows_of_band(session, frame, winner_cells_)),
      buffers_(session, frame, plan, lights, size(frame.width) * size(rows_), winner_cells_),
      segments_(table.segments.empty() ? session.view(table.first) : session.view(table.segments)),
      first_(session.view(table.first)) {
  DefrayRaysParams& p = params_;
  p.width = word(frame.width);
  p.layers = word(frame.layers);
  p.channels = static_cast<std::uint32_t>(frame.channels.size());
  p.stride = word(in_tiles(frame.width) * DEFRAY_RAY_TILE + 2 * DEFRAY_RAY_RUN);
  p.band_x = word(frame.margin / DEFRAY_RAY_TILE * DEFRAY_RAY_TILE);
  p.band_end = word(frame.width - frame.margin);
  p.cells = static_cast<std::uint32_t>(plan.cells.centres.size());
  p.tiles_x = word(in_tiles(frame.width));
  p.reach_tiles = in_tiles(reach_px_) + 1;
  p.first_bin = bins.first_bin;
  p.bin_shift = word(bins.shift);
  p.has_coverage = !frame.coverage.empty();
  p.has_rim = !plan.rim_x.empty();
  p.origin_x = plan.origin_x;
  p.origin_y = plan.origin_y;
  p.wants_winners = plan.wants_nearest ? 2 : buffers_.has_lights() ? 1 : 0;
  p.light_tiles_x = buffers_.has_lights() ? word(lights->tiles_x) : 0;
  const BinSet sharp = bins_that([&](int b) { return bins.largest_of(b) < DEFRAY_SHARP_QUANTA; });
  sharp_ = session.buffer(sizeof sharp);
  session.write(sharp_, sharp.data(), sizeof sharp);
  const auto near = bins_by_distance(bins, p.reach_tiles);
  near_ = session.buffer(near.size() * sizeof(BinSet));
  session.write(near_, near.data(), near.size() * sizeof(BinSet));
}

std::vector<BandRows> RaysGather::windows() const {
  const std::size_t a_surface =
      sizeof(cl_int) + 4 * sizeof(cl_float) + (params_.has_coverage ? 2 * sizeof(cl_uint) : 0);
  return cut_into_bands(frame_.height, reach_px_ + 1, DEFRAY_RAY_TILE,
                        params_.stride * size(frame_.layers) * a_surface,
                        session_.memory_bytes() / 2);
}

void RaysGather::prepare(const BandRows& rows) {
  Band band(session_, "rdb_pad", frame_, rows);
  window_ = {band.in(frame_.coc_quanta), band.in(frame_.depth), band.in(frame_.coverage),
             band.in(frame_.data_of), band.in(frame_.channels)};
  DefrayRaysParams& p = params_;
  p.window_y = word(rows.window_y);
  p.window_rows = word(rows.window_rows);
  p.tiles_y = word(in_tiles(rows.window_rows));
  const std::size_t lines = size(rows.window_rows + 2 * DEFRAY_RAY_ROWS) * p.layers;
  const auto plane = [&](bool is_needed) {
    return session_.buffer((is_needed ? lines * p.stride : 1) * sizeof(cl_int));
  };
  keys_ = plane(true);
  sending_ = plane(p.has_coverage);
  coverage_ = plane(p.has_coverage);
  for (std::size_t c = 0; c < 4; ++c) {
    channels_[c] = c < p.channels ? plane(true) : channels_[c - 1];
  }
  session_.launch("rdb_pad", {p.stride, lines}, p, window_.coc, window_.depth, window_.coverage,
                  window_.channels, keys_, sending_, coverage_, channels_);
  find_tiles();
}

void RaysGather::find_tiles() {
  DefrayRaysParams p = params_;
  const std::size_t bytes = std::size_t{p.tiles_x} * p.tiles_y * 2 * sizeof(BinSet);
  const cl::Buffer tiles = session_.buffer(bytes), along_x = session_.buffer(bytes);
  reach_ = session_.buffer(bytes);
  const std::vector<std::size_t> all{p.tiles_x, p.tiles_y};
  session_.launch("rdb_tiles", all, p, keys_, coverage_, tiles);
  session_.launch("rdb_reach", all, p, near_, tiles, along_x);
  p.along_y = 1;
  session_.launch("rdb_reach", all, p, near_, along_x, reach_);
}

void RaysGather::gather(int y, int rows, RayResult& out) {
  DefrayRaysParams& p = params_;
  p.band_y = word(y);
  p.band_rows = word(rows);
  const std::size_t strips_x = (p.band_end - p.band_x + DEFRAY_RAY_RUN - 1) / DEFRAY_RAY_RUN;
  const std::size_t strips_y = size((rows + DEFRAY_RAY_ROWS - 1) / DEFRAY_RAY_ROWS);
  session_.launch("rdb_gather", {strips_x, strips_y}, p, keys_, sending_, coverage_, channels_,
                  segments_, first_, reach_, sharp_, buffers_.lens, buffers_.rim_x, buffers_.rim_y,
                  buffers_.light_first, buffers_.winner, buffers_.means, buffers_.seen);
  DefrayRdbParams r = buffers_.params();
  r.window_y = p.window_y;
  r.window_rows = p.window_rows;
  r.band_y = p.band_y;
  r.band_rows = p.band_rows;
  r.cell_count = p.cells;
  r.is_first_pass = r.is_last_pass = 1;
  buffers_.find_nearest(r, window_);
  buffers_.add_light(r, window_);
  buffers_.read(r, out);
}

void RaysGather::run(RayResult& out, const Progress& progress) {
  const int first = frame_.margin, end = frame_.height - frame_.margin;
  for (const BandRows& window : windows()) {
    const int from = std::max(window.y, first), to = std::min(window.y + window.rows, end);
    if (from >= to) continue;
    prepare(window);
    for (int y = from / DEFRAY_RAY_TILE * DEFRAY_RAY_TILE; y < to; y += rows_) {
      const int rows = std::min(rows_, to - y);
      gather(y, rows, out);
      if (progress) progress(static_cast<double>(y + rows - first) / (end - first));
    }
  }
}

}  // namespace defray
