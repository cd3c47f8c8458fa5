#include "rdb.h"

#include <algorithm>

#include "error.h"

namespace defray {
namespace {

std::size_t pixels(int width, int rows) {
  return static_cast<std::size_t>(width) * static_cast<std::size_t>(rows);
}

}  // namespace

RdbRun::RdbRun(Session& session, int width, int height, const std::vector<std::int32_t>& coc_quanta,
               const Plane& depth, const std::vector<Plane>& channels, const RdbSettings& settings)
    : session_(session),
      width_(width),
      coc_(coc_quanta),
      depth_(depth),
      channels_(channels),
      seed_(settings.seed),
      cells_(make_lens_cells(settings.cells_per_side, settings.jitter)) {
  const int cells = static_cast<int>(cells_.centres.size());
  const std::size_t budget = std::min(settings.memory_bytes, session.info().max_buffer_bytes);
  passes_ = plan_rdb_passes(width, height, cells, rdb_reach(largest_coc(coc_quanta)), budget);
  const RdbPass& largest = passes_.front();
  const std::size_t band = pixels(width, largest.band_rows);
  lens_ = session.view(cells_.centres);
  winner_ = session.buffer(band * static_cast<std::size_t>(largest.cell_count) * sizeof(RdbWinner));
  sum_ = session.buffer(band * sizeof(cl_float4));
  filled_ = session.buffer(band * sizeof(cl_uint2));
}

bool RdbRun::is_last_of_band(const RdbPass& pass) const {
  return pass.first_cell + pass.cell_count == static_cast<int>(cells_.centres.size());
}

DefrayRdbParams RdbRun::params_of(const RdbPass& pass) const {
  DefrayRdbParams p{};
  p.width = static_cast<std::uint32_t>(width_);
  p.window_y = static_cast<std::uint32_t>(pass.window_y);
  p.window_rows = static_cast<std::uint32_t>(pass.window_rows);
  p.band_y = static_cast<std::uint32_t>(pass.band_y);
  p.band_rows = static_cast<std::uint32_t>(pass.band_rows);
  p.first_cell = static_cast<std::uint32_t>(pass.first_cell);
  p.cell_count = static_cast<std::uint32_t>(pass.cell_count);
  p.is_first_pass = pass.first_cell == 0;
  p.is_last_pass = is_last_of_band(pass);
  p.jitter_lens = cells_.jitter;
  p.seed = seed_;
  return p;
}

void RdbRun::view_window(const RdbPass& pass) {
  if (window_.band_y == pass.band_y) return;
  const std::size_t first = pixels(width_, pass.window_y);
  const std::size_t count = pixels(width_, pass.window_rows);
  const auto view = [&](const Plane& plane) { return session_.picture(&plane[first], count); };
  window_ = {pass.band_y, session_.view(&coc_[first], count * sizeof(coc_[0])), view(depth_), {}};
  // The kernel always sums four channels; a missing one repeats the last and is not read back.
  for (std::size_t c = 0; c < 4; ++c) {
    window_.channel[c] = c < channels_.size() ? view(channels_[c]) : window_.channel[c - 1];
  }
}

void RdbRun::scatter(const RdbPass& pass) {
  view_window(pass);
  DefrayRdbParams p = params_of(pass);
  const std::size_t cells = pixels(width_, pass.band_rows) * p.cell_count;
  session_.launch("rdb_clear", DEFRAY_RDB_CLEAR_GROUP, {cells}, p, winner_);
  const int scatters = session_.has_int64_atomics() ? 1 : 2;
  for (int i = 0; i < scatters; ++i) {
    p.is_index_pass = i == 1;
    session_.launch("rdb_scatter", DEFRAY_RDB_SCATTER_GROUP, {p.width, p.window_rows, p.cell_count},
                    p, window_.coc, window_.depth, lens_, winner_);
  }
}

void RdbRun::merge(const RdbPass& pass) {
  view_window(pass);
  const DefrayRdbParams p = params_of(pass);
  const cl::Buffer(&channel)[4] = window_.channel;
  session_.launch("rdb_merge", DEFRAY_RDB_MERGE_GROUP, {p.width, p.band_rows}, p, winner_,
                  channel[0], channel[1], channel[2], channel[3], sum_, filled_);
}

void RdbRun::read_band(const RdbPass& pass, std::vector<Plane>& out) {
  std::vector<cl_float4> means(pixels(width_, pass.band_rows));
  session_.read(sum_, means.data(), means.size() * sizeof(cl_float4));
  const std::size_t first = pixels(width_, pass.band_y);
  for (std::size_t c = 0; c < out.size(); ++c) {
    for (std::size_t i = 0; i < means.size(); ++i) out[c][first + i] = means[i].s[c];
  }
}

std::vector<RdbWinner> RdbRun::winners(const RdbPass& pass) {
  std::vector<RdbWinner> result(pixels(width_, pass.band_rows) *
                                static_cast<std::size_t>(pass.cell_count));
  session_.read(winner_, result.data(), result.size() * sizeof(RdbWinner));
  return result;
}

std::vector<Plane> render_rdb(Session& session, int width, int height,
                              const std::vector<std::int32_t>& coc_quanta, const Plane& depth,
                              const std::vector<Plane>& channels, const RdbSettings& settings,
                              const std::function<void(double)>& progress) {
  RdbRun run(session, width, height, coc_quanta, depth, channels, settings);
  std::vector<Plane> out(channels.size(), Plane(depth.size()));
  double done = 0;
  for (const RdbPass& pass : run.passes()) {
    run.scatter(pass);
    run.merge(pass);
    run.finish();
    if (run.is_last_of_band(pass)) run.read_band(pass, out);
    done += 1;
    if (progress) progress(done / static_cast<double>(run.passes().size()));
  }
  return out;
}

}  // namespace defray
