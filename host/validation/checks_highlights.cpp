// The table's entries for highlights: which fragments are some, and their light added to the means.
#include <algorithm>
#include <cmath>

#include "chain/highlights.h"
#include "rdb/rdb.h"
#include "reference/reference.h"
#include "validation/kernel_checks.h"

namespace defray::validation {
namespace {

double pixels(const Case& c) { return static_cast<double>(c.width) * c.height; }

/// The case's fragments, every thirteenth far brighter; coverage is always there, and 0 where there
/// is no fragment, as the stages leave it.
Fragments bright_fragments(const Input& in) {
  Fragments f = in.fragments;
  if (f.coverage.empty()) f.coverage.assign(f.depth.size(), DEFRAY_WHOLE);
  for (std::size_t i = 0; i < f.depth.size(); ++i) {
    if (!is_fragment(f.depth[i])) f.coverage[i] = 0;
  }
  for (std::size_t i = 5; i < f.depth.size(); i += 13) {
    for (Plane& plane : f.channels) plane[i] *= 500;
  }
  return f;
}

int light_channels(const Case& c) { return std::max(1, c.channels - static_cast<int>(c.seed % 2)); }

Values run_highlights(Session& session, const Case& c, const Input& in) {
  return {{}, {highlights(session, bright_fragments(in), light_channels(c), stage_memory(c))}};
}

Values twin_highlights(const Case& c, const Input& in) {
  return {{}, {reference::highlights(bright_fragments(in), light_channels(c))}};
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
struct Parts {
  Fragments fragments;
  LightSources lights;
  RdbSettings settings;

  Parts(const Case& c, const Input& in)
      : fragments(bright_fragments(in)), settings(rdb_settings(c)) {
    const int light = light_channels(c);
    const Plane kept = reference::highlights(fragments, light);
    const LensCells cells = lens_cells(settings);
    lights = take_light(fragments, kept, light, aperture_table(), cells);
    const std::size_t a_pixel = cells.centres.size() * rdb_bytes_a_cell + rdb_bytes_a_sum;
    if (c.band_rows > 0) {
      settings.memory_bytes =
          static_cast<std::size_t>(c.band_rows) * static_cast<std::size_t>(c.width) * a_pixel;
    }
  }
};

Values run_add(Session& session, const Case& c, const Input& in) {
  const Parts p(c, in);
  return {{}, distribute_rays(session, FragmentView(p.fragments), p.settings, &p.lights).means};
}

Values twin_add(const Case& c, const Input& in) {
  const Parts p(c, in);
  return {{}, reference::distribute_rays(FragmentView(p.fragments), p.settings, &p.lights).means};
}

double add_work(const Case& c) {
  const double disc = std::min(std::pow(2 * c.coc_px + 5, 2), pixels(c));
  return 4 * pixels(c) * c.cells * c.cells + pixels(c) / 6 * disc * 8;
}

constexpr const char* rule = "equal bits: + - x / sqrt in one order";

}  // namespace

std::vector<KernelCheck> highlight_checks() {
  return {{"highlights", rule, run_highlights, twin_highlights, highlights_work},
          {"highlights_add", rule, run_add, twin_add, add_work}};
}

}  // namespace defray::validation
