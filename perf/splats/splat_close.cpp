// Two sheets one behind the other, closer and closer, and two that cross: what becomes of surfaces
// that splats can hardly tell apart (Krivanek & Zara 2003, section 5: their averages bleed).
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
  SplatShot both, one, other;
};

Sheets make_sheets(const PointCloud& one, const PointCloud& other) {
  PointCloud both = one;
  const auto append = [](auto& all, const auto& more) {
    all.insert(all.end(), more.begin(), more.end());
  };
  append(both.positions, other.positions);
  append(both.normals, other.normals);
  append(both.colours, other.colours);
  const auto shot_of = [](const PointCloud& cloud) {
    return SplatShot{"sheets", distance, tree_of(cloud)};
  };
  return {shot_of(both), shot_of(one), shot_of(other)};
}

Sheets behind_each_other(int side, double gap) {
  PointCloud front, back;
  add_sheet(front, side, behind + gap, true, {0.9f, 0.6f, 0.2f}, {0.5f, 0.1f, 0.1f});
  add_sheet(back, side, behind, false, {0.1f, 0.2f, 0.7f}, {0.05f, 0.4f, 0.3f});
  return make_sheets(front, back);
}

/// The built-in model: its first half is the one, its second the other.
Sheets crossing(int side) {
  const PointCloud all = make_point_cloud("crossing", 2 * size(side) * size(side));
  const auto half = [&](bool is_second) {
    const auto of = [&](const auto& values) {
      const auto middle = values.begin() + std::ssize(values) / 2;
      return is_second ? std::vector(middle, values.end()) : std::vector(values.begin(), middle);
    };
    PointCloud cloud;
    cloud.positions = of(all.positions);
    cloud.normals = of(all.normals);
    cloud.colours = of(all.colours);
    return cloud;
  };
  return make_sheets(half(false), half(true));
}

/// Both rules' PSNR, sharp and blurred, to each drawn by itself.
std::vector<std::string> cells_of(const Bench& bench, const Sheets& sheets) {
  const int pixels = bench.size(512);
  std::vector<std::string> cells;
  for (const double aperture : {0.0, aperture_mm}) {
    const int views = aperture == 0 ? 1 : bench.is_quick ? 20 : 200;
    const std::vector<Plane> truth =
        mean_of_views(bench.backend, {&sheets.one.tree, &sheets.other.tree},
                      splat_view(sheets.both, pixels, pixels, aperture), views);
    for (const SplatMerge merge : {SplatMerge::nearest, SplatMerge::average}) {
      SplatSettings settings;
      settings.merge = merge;
      const DefraySplatParams view = splat_view(sheets.both, pixels, pixels, aperture, settings);
      const SplatRun run = run_splats(bench, sheets.both, view, true);
      cells.push_back(fixed(compare(run.picture, truth, pixels).psnr_srgb_db));
    }
  }
  return cells;
}

}  // namespace

Figures measure_close_splats(TableBench& b) {
  const Bench& bench = b.bench();
  const int side = bench.is_quick ? 48 : 256;
  const double spacing = 2 * half_side / side;
  Table table{
      "",
      "",
      {"gap, distances of points", "sharp: nearest", "average", "300 mm: nearest", "average"},
      {}};
  const auto add_row = [&](const std::string& gap, const Sheets& sheets) {
    std::vector<std::string> row = cells_of(bench, sheets);
    row.insert(row.begin(), gap);
    table.rows.push_back(std::move(row));
  };
  for (const double gap : {0.25, 1.0, 4.0, 16.0}) {
    add_row(fixed(gap), behind_each_other(side, gap * spacing));
  }
  add_row("crossing", crossing(side));
  return {table, {}};
}

}  // namespace defray::perf
