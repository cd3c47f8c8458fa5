// The ray distribution buffers: by `rdb_gather` where nothing is random, else by `rdb_scatter`.
#include <algorithm>

#include "device/device_backend.h"
#include "device/rays_gather.h"
#include "device/rdb_run.h"

namespace defray {
namespace {

void scatter(Session& session, const Frame& frame, const RayPlan& plan, const LightSources* lights,
             const Progress& progress, RayResult& out) {
  RdbRun run(session, frame, plan, lights);
  double done = 0;
  for (const RdbPass& pass : run.passes()) {
    run.scatter(pass);
    run.merge(pass);
    run.finish();
    if (run.is_last_of_band(pass)) run.read_band(pass, out);
    done += 1;
    if (progress) progress(done / static_cast<double>(run.passes().size()));
  }
}

}  // namespace

RayResult DeviceBackend::rays(const Frame& frame, const RayPlan& plan, const LightSources* lights,
                              const Progress& progress) {
  const std::size_t pixels = size(frame.wanted_rows().count()) * size(frame.width);
  RayResult out{std::vector<Plane>(frame.channels.size(), Plane(pixels)),
                std::vector<std::uint32_t>(pixels)};
  if (plan.wants_nearest) out.nearest.resize(pixels);
  if (plan.by == RaysBy::gather && plan.lens.jitter == 0) {
    if (frame.wanted_rows().y == 0) winners_ = {};
    RaysGather(session_, frame, plan, lights, winners_).run(out, progress);
    if (frame.wanted_rows().end == frame.height) winners_ = {};
  } else {
    scatter(session_, frame, plan, lights, progress, out);
  }
  return out;
}

RayTiles DeviceBackend::ray_tiles(const Frame& frame, const RayPlan& plan) {
  RayTileWindow window(session_, frame, plan, bins_of(frame));
  window.prepare({0, frame.height, 0, frame.height});
  return window.read();
}

}  // namespace defray
