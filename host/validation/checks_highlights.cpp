// The table's entries for highlights: which fragments are some, and their light added to the means.
#include <algorithm>

#include "chain/steps/highlights.h"
#include "rdb/rdb_plan.h"
#include "reference/reference.h"
#include "reference/twin_backend.h"
#include "validation/either.h"
#include "validation/kernel_checks.h"
#include "validation/stage_input.h"
#include "validation/work.h"

namespace defray::validation {
namespace {

int light_channels(const Case& c) { return std::max(1, c.channels - static_cast<int>(c.seed % 2)); }

Outcome run_highlights(Backend& backend, const Case& c, const Input& in) {
  const auto kept = backend.highlights(bright_fragments(in), light_channels(c));
  return {{}, {Plane(kept.begin(), kept.end())}};
}

std::size_t highlights_memory(const Case& c, const Input& in) {
  return band_memory("highlights", c, in.fragments.layers);
}

/// Sources as boxes of all sizes.
void make_boxes(const Frame& f, LightSources& lights) {
  for (std::size_t i = 0; i < lights.where.size(); ++i) {
    const auto step = static_cast<std::int32_t>(i);
    lights.where[i][3] = 1 + step % DEFRAY_LIGHT_GROUP +
                         DEFRAY_LIGHT_ROW * (1 + step / DEFRAY_LIGHT_GROUP % DEFRAY_LIGHT_GROUP);
  }
  if (!lights.empty()) sort_into_tiles(lights, f.width, f.height);
}

/// Fragments without their highlights, and these.
Outcome run_add(Backend& backend, const Case& c, const Input& in) {
  Frame f = bright_fragments(in);
  const int light = light_channels(c);
  const RayPlan plan = ray_plan(c);
  const auto kept = reference::TwinBackend().highlights(f, light);
  LightSources lights = take_light(f, kept, light, lopsided_aperture());
  make_boxes(f, lights);
  return {{}, backend.rays(f, plan, &lights).means};
}

Outcome run_maps(Backend& backend, const Case& c, const Input& in) {
  Frame f = bright_fragments(in);
  const int light = light_channels(c);
  const auto kept = reference::TwinBackend().highlights(f, light);
  LightSources lights = take_light(f, kept, light, lopsided_aperture());
  make_boxes(f, lights);
  const std::vector<std::uint8_t> maps = either(
      backend, [&](DeviceBackend& d) { return d.light_maps(f, lights); },
      [&] { return reference::light_maps(lights, f); });
  return {{maps.begin(), maps.end()}, {}};
}

/// A pass of so many rows with one cell.
std::size_t add_memory(const Case& c, const Input&) {
  return size(c.band_rows) * size(c.width) * rdb_bytes_a_pixel(1);
}

constexpr const char* rule = "equal bits: + - x / sqrt in one order";

}  // namespace

std::vector<KernelCheck> highlight_checks() {
  return {
      {"highlights", rule, run_highlights, highlights_work, nullptr, nullptr, highlights_memory},
      {"highlights_add", rule, run_add, add_work, nullptr, nullptr, add_memory},
      {"light_maps", "equal: + - x / sqrt in one order", run_maps, light_maps_work}};
}

}  // namespace defray::validation
