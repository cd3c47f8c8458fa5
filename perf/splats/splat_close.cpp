// Two sheets one behind the other, closer and closer: what becomes of surfaces that splats can
// hardly tell apart (Krivanek & Zara 2003, section 5: their averages bleed).
#include <cmath>

#include "measure/metrics.h"
#include "splat/surfels/surfels.h"
#include "splats/splat_shots.h"
#include "tables/tables.h"

namespace defray::perf {
namespace {

constexpr double distance = 3.2, half_side = 0.8, aperture_mm = 300;
/// The back one's place: behind the focus, CoC radius 7 px at 512x512.
constexpr double behind = -0.8;

/// A square grid of points before the camera, of the left half alone or of all of it.
void add_sheet(PointCloud& cloud, int side, double z, bool is_half,
               const std::array<float, 3>& light, const std::array<float, 3>& dark) {
  for (int j = 0; j < side; ++j) {
    for (int i = 0; i < (is_half ? side / 2 : side); ++i) {
      const auto along = [&](int k) { return half_side * (2 * (k + 0.5) / side - 1); };
      cloud.positions.push_back(
          {static_cast<float>(along(i)), static_cast<float>(along(j)), static_cast<float>(z)});
      cloud.normals.push_back({0, 0, 1});
      cloud.colours.push_back((i * 12 / side + j * 12 / side) % 2 == 0 ? light : dark);
    }
  }
}

/// Together, and each by itself.
struct Sheets {
  SplatShot both, front, back;
};

Sheets make_sheets(int side, double gap) {
  PointCloud front, back;
  add_sheet(front, side, behind + gap, true, {0.9f, 0.6f, 0.2f}, {0.5f, 0.1f, 0.1f});
  add_sheet(back, side, behind, false, {0.1f, 0.2f, 0.7f}, {0.05f, 0.4f, 0.3f});
  PointCloud both = front;
  both.positions.insert(both.positions.end(), back.positions.begin(), back.positions.end());
  both.normals.insert(both.normals.end(), back.normals.begin(), back.normals.end());
  both.colours.insert(both.colours.end(), back.colours.begin(), back.colours.end());
  const auto shot_of = [](const PointCloud& cloud) {
    return SplatShot{"sheets", distance, tree_of(cloud)};
  };
  return {shot_of(both), shot_of(front), shot_of(back)};
}

}  // namespace

Figures measure_close_splats(TableBench& b) {
  const Bench& bench = b.bench();
  const int side = bench.is_quick ? 48 : 256, pixels = bench.size(512);
  const double spacing = 2 * half_side / side;
  Table table{
      "",
      "",
      {"gap, distances of points", "sharp: nearest", "average", "300 mm: nearest", "average"},
      {}};
  for (const double gap : {0.25, 1.0, 4.0, 16.0}) {
    const Sheets sheets = make_sheets(side, gap * spacing);
    std::vector<std::string> row{fixed(gap)};
    for (const double aperture : {0.0, aperture_mm}) {
      const std::vector<Plane> truth =
          mean_of_views(bench.backend, {&sheets.front.tree, &sheets.back.tree},
                        splat_view(sheets.both, pixels, pixels, aperture),
                        aperture == 0    ? 1
                        : bench.is_quick ? 20
                                         : 200);
      for (const SplatMerge merge : {SplatMerge::nearest, SplatMerge::average}) {
        SplatSettings settings;
        settings.merge = merge;
        const DefraySplatParams view = splat_view(sheets.both, pixels, pixels, aperture, settings);
        const SplatRun run = run_splats(bench, sheets.both, view, true);
        row.push_back(fixed(compare(run.picture, truth, pixels).psnr_srgb_db));
      }
    }
    table.rows.push_back(std::move(row));
  }
  return {table, {}};
}

}  // namespace defray::perf
