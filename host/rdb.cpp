#include "rdb.h"

#include <algorithm>
#include <cstdlib>

#include "error.h"

namespace defray {
namespace {

constexpr std::size_t bytes_per_cell = sizeof(RdbWinner);
/// A pass that stays in the last-level cache scatters twice as fast as one that does not; below a
/// band height of a few reaches, rows that two bands share cost more than that.
constexpr std::size_t pass_bytes_in_cache = std::size_t{16} << 20;
constexpr std::size_t bytes_per_sum = sizeof(cl_float4) + sizeof(cl_uint2);

DefrayRdbParams params_of(const RdbPass& pass, int width, int total_cells, const LensCells& cells,
                          std::uint32_t seed) {
  DefrayRdbParams p{};
  p.width = static_cast<std::uint32_t>(width);
  p.window_y = static_cast<std::uint32_t>(pass.window_y);
  p.window_rows = static_cast<std::uint32_t>(pass.window_rows);
  p.band_y = static_cast<std::uint32_t>(pass.band_y);
  p.band_rows = static_cast<std::uint32_t>(pass.band_rows);
  p.first_cell = static_cast<std::uint32_t>(pass.first_cell);
  p.cell_count = static_cast<std::uint32_t>(pass.cell_count);
  p.is_first_pass = pass.first_cell == 0;
  p.is_last_pass = pass.first_cell + pass.cell_count == total_cells;
  p.jitter_lens = cells.jitter;
  p.seed = seed;
  return p;
}

/// A device view of the rows [first_row, first_row + rows) of a plane.
template <typename T>
cl::Buffer view_rows(Session& session, const std::vector<T>& plane, int width, int first_row,
                     int rows) {
  const std::size_t offset = static_cast<std::size_t>(first_row) * static_cast<std::size_t>(width);
  const std::size_t count = static_cast<std::size_t>(rows) * static_cast<std::size_t>(width);
  return session.view(plane.data() + offset, count * sizeof(T));
}

std::size_t band_pixels(int width, const RdbPass& pass) {
  return static_cast<std::size_t>(width) * static_cast<std::size_t>(pass.band_rows);
}

cl::Buffer lens_buffer(Session& session, const LensCells& cells) {
  return session.view(cells.centres.data(), cells.centres.size() * sizeof(cells.centres[0]));
}

/// Empties the cells and scatters into them; twice where 64-bit atomics are missing.
void scatter(Session& session, DefrayRdbParams p, const cl::Buffer& coc, const cl::Buffer& depth,
             const cl::Buffer& lens, const cl::Buffer& winner) {
  const std::size_t cells = std::size_t{p.cell_count} * p.band_rows * p.width;
  session.launch("rdb_clear", DEFRAY_RDB_CLEAR_GROUP, {cells}, p, winner);
  const int scatters = session.has_int64_atomics() ? 1 : 2;
  for (int i = 0; i < scatters; ++i) {
    p.is_index_pass = i == 1;
    session.launch("rdb_scatter", DEFRAY_RDB_SCATTER_GROUP, {p.width, p.window_rows, p.cell_count},
                   p, coc, depth, lens, winner);
  }
}

/// The source rows that can reach a band, on the device.
struct SourceWindow {
  cl::Buffer coc, depth, channel[4];
};

SourceWindow view_window(Session& session, int width, const RdbPass& pass,
                         const std::vector<std::int32_t>& coc, const Plane& depth,
                         const std::vector<Plane>& channels) {
  const auto view = [&](const auto& plane) {
    return view_rows(session, plane, width, pass.window_y, pass.window_rows);
  };
  SourceWindow window{view(coc), view(depth), {}};
  // The kernel always sums four channels; a missing one repeats the last and is not read back.
  for (std::size_t c = 0; c < 4; ++c) {
    window.channel[c] = c < channels.size() ? view(channels[c]) : window.channel[c - 1];
  }
  return window;
}

/// Reads a finished band's means and moves them to the output planes.
void store_band(Session& session, const cl::Buffer& sum, int width, const RdbPass& pass,
                std::vector<Plane>& out) {
  std::vector<cl_float4> means(band_pixels(width, pass));
  session.read(sum, means.data(), means.size() * sizeof(cl_float4));
  const std::size_t first = static_cast<std::size_t>(pass.band_y) * static_cast<std::size_t>(width);
  for (std::size_t c = 0; c < out.size(); ++c) {
    for (std::size_t i = 0; i < means.size(); ++i) out[c][first + i] = means[i].s[c];
  }
}

}  // namespace

int rdb_reach(std::int32_t largest_coc_quanta) {
  // |u| <= 1 for every ray that counts, and a ray lands within half a pixel of p + r u.
  return (largest_coc_quanta >> DEFRAY_COC_FRACTION_BITS) + 1;
}

std::vector<RdbPass> plan_rdb_passes(int width, int height, int cell_count, int reach,
                                     std::size_t memory_bytes) {
  const std::size_t row_bytes = static_cast<std::size_t>(width) * (bytes_per_cell + bytes_per_sum);
  if (memory_bytes < row_bytes) {
    fail(ExitCode::usage,
         "--memory is {} bytes: one row of {} pixels needs at least {} bytes (1 MiB will do)",
         memory_bytes, width, row_bytes);
  }
  const std::size_t tall_enough = 4 * static_cast<std::size_t>(reach);
  const std::size_t rows_wanted = std::max(pass_bytes_in_cache / row_bytes, tall_enough);
  const int rows = static_cast<int>(std::max<std::size_t>(
      1, std::min({static_cast<std::size_t>(height), memory_bytes / row_bytes, rows_wanted})));
  const std::size_t band = static_cast<std::size_t>(width) * static_cast<std::size_t>(rows);
  const std::size_t pass_bytes =
      std::max(std::min(memory_bytes, pass_bytes_in_cache), row_bytes * static_cast<std::size_t>(rows));
  const std::size_t for_cells = pass_bytes - band * bytes_per_sum;
  const int cells = static_cast<int>(std::min<std::size_t>(
      static_cast<std::size_t>(cell_count), for_cells / (band * bytes_per_cell)));
  std::vector<RdbPass> passes;
  for (int y = 0; y < height; y += rows) {
    RdbPass pass{};
    pass.band_y = y;
    pass.band_rows = std::min(rows, height - y);
    pass.window_y = static_cast<int>(std::max<std::int64_t>(0, std::int64_t{y} - reach));
    const std::int64_t end = std::int64_t{y} + pass.band_rows + reach;
    pass.window_rows = static_cast<int>(std::min<std::int64_t>(height, end)) - pass.window_y;
    for (int k = 0; k < cell_count; k += cells) {
      pass.first_cell = k;
      pass.cell_count = std::min(cells, cell_count - k);
      passes.push_back(pass);
    }
  }
  return passes;
}

std::vector<std::int32_t> coc_on_device(Session& session, const Lens& lens, int display_width_px,
                                        const Plane& depth) {
  std::vector<std::int32_t> coc(depth.size());
  constexpr std::size_t chunk = std::size_t{1} << 24;  // bounds the device's memory
  for (std::size_t first = 0; first < depth.size(); first += chunk) {
    const std::size_t count = std::min(chunk, depth.size() - first);
    const DefrayCocParams p =
        coc_params(lens, display_width_px, static_cast<std::uint32_t>(count));
    const cl::Buffer in = session.view(depth.data() + first, count * sizeof(float));
    const cl::Buffer out = session.buffer(count * sizeof(std::int32_t));
    session.launch("coc", DEFRAY_COC_GROUP, {count}, p, in, out);
    session.read(out, coc.data() + first, count * sizeof(std::int32_t));
  }
  return coc;
}

std::vector<RdbWinner> rdb_winners_on_device(Session& session, int width, const RdbPass& pass,
                                             const LensCells& cells, std::uint32_t seed,
                                             const std::vector<std::int32_t>& coc_quanta,
                                             const Plane& depth) {
  const int total = static_cast<int>(cells.centres.size());
  const DefrayRdbParams p = params_of(pass, width, total, cells, seed);
  std::vector<RdbWinner> winners(band_pixels(width, pass) *
                                 static_cast<std::size_t>(pass.cell_count));
  const std::size_t bytes = winners.size() * bytes_per_cell;
  const cl::Buffer winner = session.buffer(bytes);
  scatter(session, p, view_rows(session, coc_quanta, width, pass.window_y, pass.window_rows),
          view_rows(session, depth, width, pass.window_y, pass.window_rows),
          lens_buffer(session, cells), winner);
  session.read(winner, winners.data(), bytes);
  return winners;
}

std::vector<Plane> render_rdb(Session& session, int width, int height,
                              const std::vector<std::int32_t>& coc_quanta, const Plane& depth,
                              const std::vector<Plane>& channels, const RdbSettings& settings,
                              const std::function<void(double)>& progress) {
  const LensCells cells = make_lens_cells(settings.cells_per_side, settings.jitter);
  const int total = static_cast<int>(cells.centres.size());
  std::int32_t largest = 0;
  for (const std::int32_t q : coc_quanta) largest = std::max(largest, std::abs(q));
  const std::size_t budget = std::min(settings.memory_bytes, session.info().max_buffer_bytes);
  const std::vector<RdbPass> passes =
      plan_rdb_passes(width, height, total, rdb_reach(largest), budget);

  const RdbPass& biggest = passes.front();
  const std::size_t band = band_pixels(width, biggest);
  const cl::Buffer winner =
      session.buffer(band * static_cast<std::size_t>(biggest.cell_count) * bytes_per_cell);
  const cl::Buffer sum = session.buffer(band * sizeof(cl_float4));
  const cl::Buffer filled = session.buffer(band * sizeof(cl_uint2));
  const cl::Buffer lens = lens_buffer(session, cells);
  std::vector<Plane> out(channels.size(), Plane(depth.size()));

  SourceWindow window;
  for (std::size_t i = 0; i < passes.size(); ++i) {
    const RdbPass& pass = passes[i];
    const DefrayRdbParams p = params_of(pass, width, total, cells, settings.seed);
    if (p.is_first_pass) {
      window = view_window(session, width, pass, coc_quanta, depth, channels);
    }
    scatter(session, p, window.coc, window.depth, lens, winner);
    session.launch("rdb_merge", DEFRAY_RDB_MERGE_GROUP, {p.width, p.band_rows}, p, winner,
                   window.channel[0], window.channel[1], window.channel[2], window.channel[3], sum,
                   filled);
    session.finish();
    if (p.is_last_pass) store_band(session, sum, width, pass, out);
    if (progress) progress(static_cast<double>(i + 1) / static_cast<double>(passes.size()));
  }
  return out;
}

}  // namespace defray
