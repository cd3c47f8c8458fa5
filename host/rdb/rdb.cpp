#include "rdb/rdb.h"

#include <algorithm>

#include "base/error.h"
#include "lens/cats_eye.h"

namespace defray {
namespace {

std::size_t pixels(int width, int rows) {
  return static_cast<std::size_t>(width) * static_cast<std::size_t>(rows);
}

}  // namespace

LensCells lens_cells(const RdbSettings& settings) {
  if (!settings.samples.centres.empty()) return settings.samples;
  return make_lens_cells(settings.cells_per_side, settings.jitter);
}

std::size_t open_cells(const RdbSettings& settings, const LensCells& cells, std::size_t x,
                       std::size_t y) {
  if (settings.rim_x.empty()) return cells.centres.size();
  const RimCentre rim{settings.rim_x[x], settings.rim_y[y]};
  return static_cast<std::size_t>(
      std::count_if(cells.centres.begin(), cells.centres.end(),
                    [&](const auto& u) { return passes_rim(rim, u[0], u[1]); }));
}

std::vector<std::uint32_t> or_own_pixel(std::vector<std::uint32_t> nearest) {
  for (std::size_t i = 0; i < nearest.size(); ++i) {
    if (nearest[i] == DEFRAY_EMPTY) nearest[i] = static_cast<std::uint32_t>(i);
  }
  return nearest;
}

RdbRun::RdbRun(Session& session, const FragmentView& fragments, const RdbSettings& settings,
               const LightSources* lights)
    : session_(session),
      fragments_(fragments),
      settings_(settings),
      cells_(lens_cells(settings)),
      lights_(lights && !lights->empty() ? lights : nullptr) {
  const int cells = static_cast<int>(cells_.centres.size());
  const std::size_t budget = std::min(settings.memory_bytes, session.info().max_buffer_bytes);
  const int reach = rdb_reach(largest_coc(fragments.coc_quanta));
  passes_ = plan_rdb_passes(fragments.width, fragments.height, cells, reach, budget, lights_);
  const RdbPass& largest = passes_.front();
  const std::size_t band = pixels(fragments.width, largest.band_rows);
  lens_ = session.view(cells_.centres);
  rim_x_ = settings_.rim_x.empty() ? lens_ : session.view(settings_.rim_x);
  rim_y_ = settings_.rim_y.empty() ? lens_ : session.view(settings_.rim_y);
  winner_ = session.buffer(band * static_cast<std::size_t>(largest.cell_count) * sizeof(RdbWinner));
  sum_ = session.buffer(band * sizeof(cl_float4));
  filled_ = session.buffer(band * sizeof(cl_uint2));
  seen_ = session.buffer(band * sizeof(cl_uint));
  if (settings_.wants_nearest) nearest_ = session.buffer(band * sizeof(cl_uint2));
  if (!lights_) return;
  light_ = {session.view(lights_->first), session.view(lights_->list),
            session.view(lights_->where), session.view(lights_->excess),
            session.view(lights_->table), session.view(lights_->cell_map)};
}

bool RdbRun::is_last_of_band(const RdbPass& pass) const {
  return pass.first_cell + pass.cell_count == static_cast<int>(cells_.centres.size());
}

DefrayRdbParams RdbRun::params_of(const RdbPass& pass) const {
  DefrayRdbParams p{};
  p.width = static_cast<std::uint32_t>(fragments_.width);
  p.window_y = static_cast<std::uint32_t>(pass.window_y);
  p.window_rows = static_cast<std::uint32_t>(pass.window_rows);
  p.band_y = static_cast<std::uint32_t>(pass.band_y);
  p.band_rows = static_cast<std::uint32_t>(pass.band_rows);
  p.first_cell = static_cast<std::uint32_t>(pass.first_cell);
  p.cell_count = static_cast<std::uint32_t>(pass.cell_count);
  p.is_first_pass = pass.first_cell == 0;
  p.is_last_pass = is_last_of_band(pass);
  p.jitter_lens = cells_.jitter;
  p.seed = settings_.seed;
  p.layers = static_cast<std::uint32_t>(fragments_.layers);
  p.has_coverage = fragments_.coverage != nullptr;
  p.origin_x = settings_.origin_x;
  p.origin_y = settings_.origin_y;
  p.has_rim = !settings_.rim_x.empty();
  p.all_cells = static_cast<std::uint32_t>(cells_.centres.size());
  p.has_data_of = fragments_.data_of != nullptr;
  return p;
}

void RdbRun::view_window(const RdbPass& pass) {
  if (window_.band_y == pass.band_y) return;
  const BandOnDevice band(session_, {pass.band_y, pass.band_rows, pass.window_y, pass.window_rows},
                          pixels(fragments_.width, fragments_.layers));
  window_ = {pass.band_y,
             band.view(fragments_.coc_quanta),
             band.picture(fragments_.depth),
             lens_,
             lens_,
             ChannelsOnDevice(band, fragments_.channels)};
  if (fragments_.coverage) window_.coverage = band.view(*fragments_.coverage);
  if (fragments_.data_of) window_.data_of = band.view(*fragments_.data_of);
}

void RdbRun::scatter(const RdbPass& pass) {
  view_window(pass);
  DefrayRdbParams p = params_of(pass);
  const std::size_t cells = pixels(fragments_.width, pass.band_rows) * p.cell_count;
  session_.launch("rdb_clear", DEFRAY_RDB_CLEAR_GROUP, {cells}, p, winner_);
  const int scatters = session_.has_int64_atomics() ? 1 : 2;
  for (int i = 0; i < scatters; ++i) {
    p.is_index_pass = i == 1;
    session_.launch("rdb_scatter", DEFRAY_RDB_SCATTER_GROUP,
                    {p.width, std::size_t{p.window_rows} * p.layers, p.cell_count}, p, window_.coc,
                    window_.depth, window_.coverage, lens_, winner_);
  }
}

void RdbRun::merge(const RdbPass& pass) {
  view_window(pass);
  const DefrayRdbParams p = params_of(pass);
  const cl::Buffer(&channel)[4] = window_.channels->of;
  session_.launch("rdb_merge", DEFRAY_RDB_MERGE_GROUP, {p.width, p.band_rows}, p, winner_,
                  window_.coverage, window_.depth, lens_, rim_x_, rim_y_, channel[0], channel[1],
                  channel[2], channel[3], sum_, filled_, seen_);
}

void RdbRun::nearest(const RdbPass& pass) {
  if (!settings_.wants_nearest) return;
  view_window(pass);
  const DefrayRdbParams p = params_of(pass);
  session_.launch("rdb_nearest", DEFRAY_RDB_MERGE_GROUP, {p.width, p.band_rows}, p, winner_,
                  window_.data_of, lens_, rim_x_, rim_y_, nearest_);
}

void RdbRun::add_light(const RdbPass& pass) {
  if (!lights_) return;
  const DefrayRdbParams p = params_of(pass);
  const DefrayLightParams l{static_cast<std::uint32_t>(lights_->tiles_x), lights_->share_of_light};
  session_.launch("highlights_add", DEFRAY_RDB_MERGE_GROUP, {p.width, p.band_rows}, p, l,
                  light_.first, light_.list, light_.where, light_.excess, light_.table,
                  light_.cell_map, winner_, window_.coc, window_.coverage, rim_x_, rim_y_, sum_);
}

void RdbRun::read_band(const RdbPass& pass, RdbResult& out) {
  std::vector<cl_float4> means(pixels(fragments_.width, pass.band_rows));
  session_.read(sum_, means.data(), means.size() * sizeof(cl_float4));
  const std::size_t first = pixels(fragments_.width, pass.band_y);
  for (std::size_t c = 0; c < out.means.size(); ++c) {
    for (std::size_t i = 0; i < means.size(); ++i) out.means[c][first + i] = means[i].s[c];
  }
  session_.read(seen_, &out.seen[first], means.size() * sizeof(cl_uint));
  if (!settings_.wants_nearest) return;
  std::vector<RdbWinner> nearest(means.size());
  session_.read(nearest_, nearest.data(), nearest.size() * sizeof(RdbWinner));
  const std::size_t window = pixels(fragments_.width * fragments_.layers, pass.window_y);
  for (std::size_t i = 0; i < nearest.size(); ++i) {
    const std::uint32_t source = nearest[i].source;
    out.nearest[first + i] =
        source == DEFRAY_EMPTY ? DEFRAY_EMPTY : fragments_.data_pixel(window + source);
  }
}

std::vector<RdbWinner> RdbRun::winners(const RdbPass& pass) {
  std::vector<RdbWinner> result(pixels(fragments_.width, pass.band_rows) *
                                static_cast<std::size_t>(pass.cell_count));
  session_.read(winner_, result.data(), result.size() * sizeof(RdbWinner));
  return result;
}

RdbResult distribute_rays(Session& session, const FragmentView& fragments,
                          const RdbSettings& settings, const LightSources* lights,
                          const std::function<void(double)>& progress) {
  RdbRun run(session, fragments, settings, lights);
  const std::size_t count = pixels(fragments.width, fragments.height);
  RdbResult out{std::vector<Plane>(fragments.channels.size(), Plane(count)),
                std::vector<std::uint32_t>(count)};
  if (settings.wants_nearest) out.nearest.resize(count);
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

std::vector<Plane> render_rdb(Session& session, int width, int height,
                              const std::vector<std::int32_t>& coc_quanta, const Plane& depth,
                              const std::vector<Plane>& channels, const RdbSettings& settings,
                              const std::function<void(double)>& progress) {
  const FragmentView pixels(width, height, coc_quanta, depth, channels);
  return distribute_rays(session, pixels, settings, nullptr, progress).means;
}

}  // namespace defray
