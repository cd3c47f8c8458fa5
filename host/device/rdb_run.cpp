#include "device/rdb_run.h"

#include <algorithm>

#include "device/device_stages.h"
#include "lens/coc.h"
#include "opencl/bands.h"
#include "opencl/launch_table.h"

namespace defray {

RdbRun::RdbRun(Session& session, const Frame& frame, const RayPlan& plan,
               const LightSources* lights)
    : session_(session),
      frame_(frame),
      plan_(plan),
      holds_frame_(holds_planes(session, "rdb_merge", frame)),
      lights_(lights && !lights->empty() ? lights : nullptr) {
  const int cells = static_cast<int>(plan.cells.centres.size());
  const int reach = rdb_reach(largest_coc(frame.coc_quanta.host()));
  passes_ = plan_rdb_passes(frame.width, frame.height, cells, reach, session.memory_bytes(),
                            lights_ != nullptr);
  const RdbPass& largest = passes_.front();
  const std::size_t band = size(frame.width) * size(largest.band_rows);
  lens_ = session.view(plan.cells.centres);
  rim_x_ = plan.rim_x.empty() ? lens_ : session.view(plan.rim_x);
  rim_y_ = plan.rim_y.empty() ? lens_ : session.view(plan.rim_y);
  winner_ = session.buffer(band * size(largest.cell_count) * sizeof(RdbWinner));
  sum_ = session.buffer(band * sizeof(cl_float4));
  filled_ = session.buffer(band * sizeof(cl_uint2));
  seen_ = session.buffer(band * sizeof(cl_uint));
  if (plan.wants_nearest) nearest_ = session.buffer(band * sizeof(cl_uint2));
  if (!lights_) return;
  light_ = {session.view(lights_->first), session.view(lights_->list),
            session.view(lights_->where), session.view(lights_->excess),
            session.view(lights_->table), session.view(lights_->cell_map)};
}

bool RdbRun::is_last_of_band(const RdbPass& pass) const {
  return pass.first_cell + pass.cell_count == static_cast<int>(plan_.cells.centres.size());
}

std::size_t RdbRun::first_source(const RdbPass& pass) const {
  return size(window_y(pass)) * size(frame_.layers) * size(frame_.width);
}

DefrayRdbParams RdbRun::params_of(const RdbPass& pass) const {
  DefrayRdbParams p{};
  p.width = word(frame_.width);
  p.window_y = word(window_y(pass));
  p.window_rows = word(pass.window_y + pass.window_rows - window_y(pass));
  p.band_y = word(pass.band_y);
  p.band_rows = word(pass.band_rows);
  p.first_cell = word(pass.first_cell);
  p.cell_count = word(pass.cell_count);
  p.is_first_pass = pass.first_cell == 0;
  p.is_last_pass = is_last_of_band(pass);
  p.jitter_lens = plan_.cells.jitter;
  p.seed = plan_.seed;
  p.layers = word(frame_.layers);
  p.has_coverage = !frame_.coverage.empty();
  p.origin_x = plan_.origin_x;
  p.origin_y = plan_.origin_y;
  p.has_rim = !plan_.rim_x.empty();
  p.all_cells = static_cast<std::uint32_t>(plan_.cells.centres.size());
  p.has_data_of = !frame_.data_of.empty();
  return p;
}

void RdbRun::view_window(const RdbPass& pass) {
  if (window_.band_y == pass.band_y || (holds_frame_ && window_.band_y >= 0)) return;
  const BandRows all{0, frame_.height, 0, frame_.height};
  const BandRows rows{pass.band_y, pass.band_rows, pass.window_y, pass.window_rows};
  Band band(session_, "rdb_scatter", frame_, holds_frame_ ? all : rows);
  window_ = {pass.band_y,
             band.in(frame_.coc_quanta),
             band.in(frame_.depth),
             band.in(frame_.coverage),
             band.in(frame_.data_of),
             band.in(frame_.channels)};
}

void RdbRun::scatter(const RdbPass& pass) {
  view_window(pass);
  DefrayRdbParams p = params_of(pass);
  const std::size_t cells = std::size_t{p.width} * p.band_rows * p.cell_count;
  session_.launch("rdb_clear", {cells}, p, winner_);
  const int scatters = session_.has_int64_atomics() ? 1 : 2;
  const std::size_t first_row = size(pass.window_y - window_y(pass)) * p.layers;
  for (int i = 0; i < scatters; ++i) {
    p.is_index_pass = i == 1;
    session_.launch_from({0, first_row, 0}, "rdb_scatter",
                         {p.width, size(pass.window_rows) * p.layers, p.cell_count}, p, window_.coc,
                         window_.depth, window_.coverage, lens_, winner_);
  }
}

void RdbRun::merge(const RdbPass& pass) {
  view_window(pass);
  const DefrayRdbParams p = params_of(pass);
  session_.launch("rdb_merge", {p.width, p.band_rows}, p, winner_, window_.coverage, window_.depth,
                  lens_, rim_x_, rim_y_, window_.channels, sum_, filled_, seen_);
}

void RdbRun::nearest(const RdbPass& pass) {
  if (!plan_.wants_nearest) return;
  view_window(pass);
  const DefrayRdbParams p = params_of(pass);
  session_.launch("rdb_nearest", {p.width, p.band_rows}, p, winner_, window_.data_of, lens_, rim_x_,
                  rim_y_, nearest_);
}

void RdbRun::add_light(const RdbPass& pass) {
  if (!lights_) return;
  const DefrayRdbParams p = params_of(pass);
  const DefrayLightParams l{word(lights_->tiles_x), lights_->share_of_light};
  session_.launch("highlights_add", {p.width, p.band_rows}, p, l, light_.first, light_.list,
                  light_.where, light_.excess, light_.table, light_.cell_map, winner_, window_.coc,
                  window_.coverage, rim_x_, rim_y_, sum_);
}

void RdbRun::read_band(const RdbPass& pass, RayResult& out) {
  std::vector<cl_float4> means(size(frame_.width) * size(pass.band_rows));
  session_.read(sum_, means.data(), means.size() * sizeof(cl_float4));
  const std::size_t first = size(frame_.width) * size(pass.band_y);
  for (std::size_t c = 0; c < out.means.size(); ++c) {
    for (std::size_t i = 0; i < means.size(); ++i) out.means[c][first + i] = means[i].s[c];
  }
  session_.read(seen_, &out.seen[first], means.size() * sizeof(cl_uint));
  if (!plan_.wants_nearest) return;
  std::vector<RdbWinner> nearest(means.size());
  session_.read(nearest_, nearest.data(), nearest.size() * sizeof(RdbWinner));
  for (std::size_t i = 0; i < nearest.size(); ++i) {
    const std::uint32_t source = nearest[i].source;
    out.nearest[first + i] =
        source == DEFRAY_EMPTY ? DEFRAY_EMPTY : frame_.data_pixel(first_source(pass) + source);
  }
}

std::vector<RdbWinner> RdbRun::winners(const RdbPass& pass) {
  std::vector<RdbWinner> result(size(frame_.width) * size(pass.band_rows) * size(pass.cell_count));
  session_.read(winner_, result.data(), result.size() * sizeof(RdbWinner));
  return result;
}

RayResult DeviceStages::rays(const Frame& frame, const RayPlan& plan, const LightSources* lights,
                             const Progress& progress) {
  RdbRun run(session_, frame, plan, lights);
  RayResult out{std::vector<Plane>(frame.channels.size(), Plane(frame.pixels())),
                std::vector<std::uint32_t>(frame.pixels())};
  if (plan.wants_nearest) out.nearest.resize(frame.pixels());
  double done = 0;
  for (const RdbPass& pass : run.passes()) {
    run.scatter(pass);
    run.merge(pass);
    run.nearest(pass);
    if (run.is_last_of_band(pass)) run.add_light(pass);
    run.finish();
    if (run.is_last_of_band(pass)) run.read_band(pass, out);
    done += 1;
    if (progress) progress(done / static_cast<double>(run.passes().size()));
  }
  return out;
}

}  // namespace defray
