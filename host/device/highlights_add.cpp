// Kernels `light_maps`, `highlights_add`.
#include <algorithm>
#include <limits>

#include "device/device_backend.h"
#include "opencl/bands.h"
#include "opencl/launch_table.h"
#include "rdb/light_sources.h"
#include "rdb/rdb_plan.h"

namespace defray {
namespace {

const LaunchRow light_maps_launch({.kernel = "light_maps",
                                   .group = {4, 1},
                                   .bytes_a_surface = 2 * Launch::plane});
const LaunchRow highlights_add_launch({.kernel = "highlights_add",
                                       .group = {1, 1},
                                       .bytes_a_target = Launch::colour});

/// Sources of light over a frame, a window at a time.
class Lights {
 public:
  /// All must stay alive and unchanged meanwhile.
  Lights(Session& session, const Frame& frame, const LightSources& lights)
      : session_(session),
        frame_(frame),
        lights_(lights),
        where_(session.view(lights.where)),
        maps_(session.view(lights.maps)),
        seen_(session.buffer(std::max<std::size_t>(lights.map_entries, 1))) {
    params_.width = word(frame.width);
    params_.layers = word(frame.layers);
    params_.has_coverage = !frame.coverage.empty();
  }

  /// Windows that fit the session's memory, with the rows that they are for.
  std::vector<BandRows> windows() const;

  /// Finds which parts of the lens see each source.
  void find_maps(const BandRows& rows);

  /// Adds the light to such rows of the means, of the last window.
  void add(Rows rows, const RayPlan& plan, RayResult& out);

  /// From find_maps, of all sources.
  std::vector<std::uint8_t> read_maps();

 private:
  Session& session_;
  const Frame& frame_;
  const LightSources& lights_;
  DefrayRdbParams params_{};
  cl::Buffer where_, maps_, seen_, coc_, coverage_;
};

// Rows that are wanted begin with a tile.
static_assert(band_step % DEFRAY_LIGHT_TILE == 0);

std::vector<BandRows> Lights::windows() const {
  const std::int32_t largest = frame_.coc_range().largest_radius();
  const std::size_t row = size(frame_.width);
  // A device that works in host memory looks at the planes where they are.
  const std::size_t memory = session_.works_in_host_memory()
                                 ? std::numeric_limits<std::size_t>::max()
                                 : session_.memory_bytes() / 2;
  return cut_into_windows(frame_.wanted_rows(), frame_.height,
                          rdb_reach(largest) + light_map_rows(largest), DEFRAY_LIGHT_TILE,
                          {row * size(frame_.layers) * launch_of("light_maps").bytes_a_surface,
                           row * launch_of("highlights_add").bytes_a_target},
                          memory);
}

void Lights::find_maps(const BandRows& rows) {
  Band band(session_, "light_maps", frame_, rows);
  coc_ = band.in(frame_.coc_quanta);
  coverage_ = band.in(frame_.coverage);
  params_.window_y = word(rows.window_y);
  params_.window_rows = word(rows.window_rows);
  if (lights_.map_entries == 0) return;
  const DefrayLightMapParams p{word(static_cast<int>(lights_.where.size())),
                               params_.width,
                               params_.layers,
                               params_.window_y,
                               params_.window_rows,
                               params_.has_coverage};
  const std::size_t runs = Lanes(session_).over_columns(DEFRAY_LIGHT_MAP * DEFRAY_LIGHT_MAP);
  session_.launch("light_maps", {runs, lights_.where.size()}, p, where_, maps_, coc_, coverage_,
                  seen_);
}

void Lights::add(Rows rows, const RayPlan& plan, RayResult& out) {
  DefrayRdbParams p = params_;
  p.has_rim = !plan.rim_x.empty();
  p.band_y = word(rows.y);
  p.band_rows = word(rows.count());
  const std::size_t first = size(rows.y - frame_.wanted_rows().y) * p.width;
  const std::size_t count = size(rows.count()) * p.width;
  std::vector<cl::Buffer> means;
  for (Plane& mean : out.means) means.push_back(lent(session_, &mean[first], count));
  const auto four = four_channels(means.size(), [&](std::size_t c) { return means[c]; });
  const cl::Buffer rim_x = p.has_rim ? session_.view(plan.rim_x) : where_;
  const cl::Buffer rim_y = p.has_rim ? session_.view(plan.rim_y) : where_;
  const DefrayLightParams l{word(lights_.tiles_x), lights_.share_of_light};
  const Lanes lanes(session_);
  session_.launch("highlights_add", {lanes.over_columns(p.width), lanes.over_rows(p.band_rows)}, p,
                  l, session_.view(lights_.first), session_.view(lights_.list), where_,
                  session_.view(lights_.excess), session_.view(lights_.table), coc_, coverage_,
                  rim_x, rim_y, maps_, seen_, four);
  for (std::size_t c = 0; c < means.size(); ++c) {
    session_.bring(means[c], count, &out.means[c][first]);
  }
}

std::vector<std::uint8_t> Lights::read_maps() {
  std::vector<std::uint8_t> maps(lights_.map_entries);
  if (!maps.empty()) session_.read(seen_, maps.data(), maps.size());
  return maps;
}

}  // namespace

std::vector<std::uint8_t> DeviceBackend::light_maps(const Frame& frame,
                                                    const LightSources& sources) {
  if (sources.empty()) return {};
  Lights lights(session_, frame, sources);
  lights.find_maps({0, frame.height, 0, frame.height});
  return lights.read_maps();
}

void DeviceBackend::add_light(const Frame& frame, const RayPlan& plan, const LightSources& sources,
                              RayResult& out) {
  Lights lights(session_, frame, sources);
  for (const BandRows& rows : lights.windows()) {
    const Rows own{std::max(rows.y, frame.margin / DEFRAY_LIGHT_TILE * DEFRAY_LIGHT_TILE),
                   std::min(rows.y + rows.rows, frame.height - frame.margin)};
    if (own.empty()) continue;
    lights.find_maps(rows);
    lights.add(own, plan, out);
  }
}

}  // namespace defray
