#include "device/rdb_scatter.h"

#include <algorithm>

#include "device/device_backend.h"
#include "lens/coc.h"
#include "opencl/bands.h"
#include "opencl/launch_table.h"

namespace defray {
namespace {

const LaunchRow rdb_clear_launch({.kernel = "rdb_clear", .group = {256, 0}});
const LaunchRow rdb_scatter_launch({.kernel = "rdb_scatter", .group = {64, 1}});

}  // namespace

RdbScatter::RdbScatter(Session& session, const Frame& frame, const RayPlan& plan)
    : session_(session),
      frame_(frame),
      cells_(plan.lens.points.size()),
      holds_frame_(holds_planes(session, "rdb_merge", frame)),
      passes_(plan_rdb_passes(
          frame.width, frame.wanted_rows(), frame.height, static_cast<int>(cells_),
          rdb_reach(frame.coc_range().largest_radius()) + span_rows(plan), session.memory_bytes())),
      buffers_(session, frame, plan, size(frame.width) * size(passes_.front().rows),
               size(passes_.front().cell_count) * sizeof(RdbWinner), winners_),
      filled_(session.buffer(size(frame.width) * size(passes_.front().rows) * sizeof(cl_uint))) {}

bool RdbScatter::is_last_of_band(const RdbPass& pass) const {
  return size(pass.first_cell + pass.cell_count) == cells_;
}

std::size_t RdbScatter::first_source(const RdbPass& pass) const {
  return size(window_y(pass)) * size(frame_.layers) * size(frame_.width);
}

DefrayRdbParams RdbScatter::params_of(const RdbPass& pass) const {
  DefrayRdbParams p = buffers_.params();
  p.window_y = word(window_y(pass));
  p.window_rows = word(pass.window_y + pass.window_rows - window_y(pass));
  p.band_y = word(pass.y);
  p.band_rows = word(pass.rows);
  p.first_cell = word(pass.first_cell);
  p.cell_count = word(pass.cell_count);
  p.winner_words = sizeof(RdbWinner) / sizeof(cl_uint);
  p.is_first_pass = pass.first_cell == 0;
  p.is_last_pass = is_last_of_band(pass);
  return p;
}

void RdbScatter::view_window(const RdbPass& pass) {
  if (window_band_y_ == pass.y || (holds_frame_ && window_band_y_ >= 0)) return;
  window_band_y_ = pass.y;
  const BandRows all{0, frame_.height, 0, frame_.height};
  Band band(session_, "rdb_scatter", frame_, holds_frame_ ? all : pass);
  window_ = {band.in(frame_.coc_quanta), band.in(frame_.depth), band.in(frame_.coverage),
             band.in(frame_.data_of), band.in(frame_.channels)};
}

void RdbScatter::scatter(const RdbPass& pass) {
  view_window(pass);
  DefrayRdbParams p = params_of(pass);
  const std::size_t cells = std::size_t{p.width} * p.band_rows * p.cell_count;
  session_.launch("rdb_clear", {cells}, p, buffers_.winner);
  const int scatters = session_.has_int64_atomics() ? 1 : 2;
  const std::size_t first_row = size(pass.window_y - window_y(pass)) * p.layers;
  for (int i = 0; i < scatters; ++i) {
    p.is_index_pass = i == 1;
    session_.launch_from({0, first_row, 0}, "rdb_scatter",
                         {p.width, size(pass.window_rows) * p.layers, p.cell_count}, p, window_.coc,
                         window_.depth, window_.coverage, buffers_.lens, buffers_.landing_radii,
                         buffers_.winner);
  }
}

void RdbScatter::run(RayResult& out, const Progress& progress) {
  double done = 0;
  for (const RdbPass& pass : passes_) {
    if (pass.first_cell == 0) begin_band(pass, out);
    scatter(pass);
    merge(pass);
    finish();
    if (is_last_of_band(pass)) end_band(pass, out);
    done += 1;
    if (progress) progress(done / static_cast<double>(passes_.size()));
  }
}

std::vector<RdbWinner> RdbScatter::winners(const RdbPass& pass) {
  std::vector<RdbWinner> result(size(frame_.width) * size(pass.rows) * size(pass.cell_count));
  session_.read(buffers_.winner, result.data(), result.size() * sizeof(RdbWinner));
  return result;
}

}  // namespace defray
