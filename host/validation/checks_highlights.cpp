// The table's entries for highlights: which fragments are some, and their light added to the means.
#include <algorithm>
#include <cmath>

#include "chain/highlights.h"
#include "rdb/rdb_plan.h"
#include "reference/twin_stages.h"
#include "validation/kernel_checks.h"

namespace defray::validation {
namespace {

double pixels(const Case& c) { return static_cast<double>(c.width) * c.height; }

/// The case's fragments, every thirteenth far brighter; coverage is always there, and 0 where there
/// is no fragment, as the stages leave it.
Frame bright_fragments(const Input& in) {
  Frame f = in.fragments;
  if (f.coverage.empty()) f.coverage = Words(f.surfaces(), DEFRAY_WHOLE);
  const auto coverage = f.coverage.edit();
  for (std::size_t i = 0; i < coverage.size(); ++i) {
    if (!is_fragment(f.depth[i])) coverage[i] = 0;
  }
  for (auto& channel : f.channels) {
    const auto plane = channel.edit();
    for (std::size_t i = 5; i < plane.size(); i += 13) plane[i] *= 500;
  }
  return f;
}

int light_channels(const Case& c) { return std::max(1, c.channels - static_cast<int>(c.seed % 2)); }

Outcome run_highlights(Stages& stages, const Case& c, const Input& in) {
  const auto kept = stages.highlights(bright_fragments(in), light_channels(c));
  return {{}, {Plane(kept.begin(), kept.end())}};
}

double highlights_work(const Case& c) { return pixels(c) * 2 * 32 * 8 + band_work(c); }

/// An aperture without symmetry, so that no mirror image passes.
const ApertureTable& aperture_table() {
  static const ApertureTable table = [] {
    ApertureMask mask;
    for (int row = 0; row < ApertureMask::side; ++row) {
      for (int column = 0; column < ApertureMask::side; ++column) {
        mask.coverage.push_back(static_cast<std::uint8_t>((column / 3 + row / 2 * 3) % 256));
      }
    }
    return make_aperture_table(mask);
  }();
  return table;
}

/// Fragments without their highlights, and these.
Outcome run_add(Stages& stages, const Case& c, const Input& in) {
  Frame f = bright_fragments(in);
  const int light = light_channels(c);
  const RayPlan plan = ray_plan(c);
  const auto kept = reference::TwinStages().highlights(f, light);
  const LightSources lights = take_light(f, kept, light, aperture_table(), plan.cells);
  return {{}, stages.rays(f, plan, &lights).means};
}

/// All cells of so many rows in one pass.
std::size_t add_memory(const Case& c, const Input&) {
  const std::size_t a_pixel = ray_plan(c).cells.centres.size() * rdb_bytes_a_cell + rdb_bytes_a_sum;
  return size(c.band_rows) * size(c.width) * a_pixel;
}

double add_work(const Case& c) {
  const double disc = std::min(std::pow(2 * c.coc_px + 5, 2), pixels(c));
  return (4 * pixels(c) + band_work(c)) * c.cells * c.cells + pixels(c) / 6 * disc * 8;
}

constexpr const char* rule = "equal bits: + - x / sqrt in one order";

}  // namespace

std::vector<KernelCheck> highlight_checks() {
  return {{"highlights", rule, run_highlights, highlights_work},
          {"highlights_add", rule, run_add, add_work, nullptr, nullptr, add_memory}};
}

}  // namespace defray::validation
