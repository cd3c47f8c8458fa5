// The ray distribution buffers: by `rdb_gather` where nothing is random, else by `rdb_scatter`.
#include <algorithm>

#include "device/device_stages.h"
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

RayResult DeviceStages::rays(const Frame& frame, const RayPlan& plan, const LightSources* lights,
                             const Progress& progress) {
  RayResult out{std::vector<Plane>(frame.channels.size(), Plane(frame.pixels())),
                std::vector<std::uint32_t>(frame.pixels())};
  if (plan.wants_nearest) out.nearest.resize(frame.pixels());
  const auto [least, largest] = std::ranges::minmax(frame.coc_quanta.host());
  const RadiusBins bins(least, largest, std::max(frame.width, frame.height));
  std::optional<SegmentTable> table;
  if (plan.by == RaysBy::gather && plan.cells.jitter == 0) {
    table =
        SegmentTable::of(plan.cells, bins, frame.width, frame.height, session_.memory_bytes() / 4);
  }
  if (table) {
    RaysGather(session_, frame, plan, bins, *table, lights).run(out, progress);
  } else {
    scatter(session_, frame, plan, lights, progress, out);
  }
  return out;
}

}  // namespace defray
