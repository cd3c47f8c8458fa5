// Kernels `light_maps`, `highlights_add`.
#include "device/device_backend.h"
#include "opencl/bands.h"
#include "opencl/launch_table.h"

namespace defray {
namespace {

const LaunchRow light_maps_launch({.kernel = "light_maps", .group = {4, 1}});
const LaunchRow highlights_add_launch({.kernel = "highlights_add", .group = {1, 1}});

}  // namespace

void RayBuffers::find_light_maps(const DefrayRdbParams& p, const RayWindow& window) {
  if (!lights_ || lights_->map_entries == 0) return;
  const std::size_t sources = lights_->where.size();
  const DefrayLightMapParams m{static_cast<std::uint32_t>(sources),
                               p.width,
                               p.layers,
                               p.window_y,
                               p.window_rows,
                               p.has_coverage,
                               frame_.coc_range().least};
  const Lanes lanes(session_);
  const std::size_t runs = lanes.over_columns(DEFRAY_LIGHT_MAP * DEFRAY_LIGHT_MAP);
  session_.launch("light_maps", {runs, sources}, m, where_, maps_, window.coc, window.coverage,
                  light_maps);
}

std::vector<std::uint8_t> DeviceBackend::light_maps(const Frame& frame,
                                                    const LightSources& lights) {
  if (lights.map_entries == 0) return {};
  Band band(session_, "light_maps", frame, {0, frame.height, 0, frame.height});
  RayWindow window;
  window.coc = band.in(frame.coc_quanta);
  window.coverage = band.in(frame.coverage);
  KeptBuffer winners;
  RayPlan plan;
  plan.lens.points = {{0, 0}};
  RayBuffers buffers(session_, frame, plan, &lights, 1, 0, winners);
  DefrayRdbParams p = buffers.params();
  p.window_rows = word(frame.height);
  buffers.find_light_maps(p, window);
  std::vector<std::uint8_t> maps(lights.map_entries);
  session_.read(buffers.light_maps, maps.data(), maps.size());
  return maps;
}

void RayBuffers::add_light(const DefrayRdbParams& p, const RayWindow& window) {
  if (!lights_) return;
  const DefrayLightParams l{word(lights_->tiles_x), lights_->share_of_light};
  const Lanes lanes(session_);
  const std::size_t rows = lanes.over_rows(p.band_y % lanes.down + p.band_rows);
  session_.launch("highlights_add", {lanes.over_columns(p.width), rows}, p, l, first_, list_,
                  where_, excess_, table_, window.coc, window.coverage, rim_x, rim_y, maps_,
                  light_maps, means);
}

}  // namespace defray
