#include "splats/splat_shots.h"

#include <cmath>

#include "base/error.h"
#include "splat/cut.h"
#include "splat/surfels/surfels.h"
#include "splat/view.h"
#include "splats/splat_naive.h"
#include "tables/tables.h"

namespace defray::perf {

Hierarchy tree_of(const PointCloud& cloud) {
  Surfels surfels = make_surfels(cloud);
  return build_hierarchy(std::move(surfels.points), std::move(surfels.ridges));
}

SplatShot make_splat_shot(const std::string& name, double distance, std::size_t points) {
  return {name, distance, tree_of(make_point_cloud(name, points))};
}

DefraySplatParams splat_view(const SplatShot& shot, int width, int height, double aperture_mm,
                             const SplatSettings& settings) {
  CameraPose pose;
  pose.from = {0, 0, shot.distance};
  Lens lens;
  lens.aperture_diameter_mm = aperture_mm;
  lens.focus_distance_units = shot.distance;
  SplatSettings sized = settings;
  sized.width = width;
  sized.height = height;
  DefraySplatParams p = splat_params(pose, {}, lens, sized);
  p.one_sided = 1;
  return p;
}

SplatRun run_splats(const Bench& bench, const SplatShot& shot, const DefraySplatParams& view,
                    bool lod) {
  SplatRun run;
  bool repeats = true;
  SplatPlanes planes;
  const auto draw = [&] {
    run.report = {};
    planes = draw_splats(bench.backend, shot.tree, view, lod, 0, run.report);
  };
  run.timing = time_of(bench.repetitions(), draw, [&] {
    if (run.picture.empty()) run.picture = planes.colour;
    repeats = repeats && run.picture == planes.colour;
    planes = {};  // as a program has written them before the next
  });
  if (!repeats) fail(ErrorKind::internal, "a timed picture differs from run to run");
  return run;
}

namespace {

/// Kernel `splat_resolve` against one splat a work-item, with the same splats. Throws
/// Error(internal) where their pictures are not the same within roundings.
std::string against_naive(const Bench& bench, const SplatShot& shot, double aperture_mm) {
  const int side = bench.size(512);
  const DefraySplatParams view = splat_view(shot, side, side, aperture_mm);
  const auto splats = in_order(
      bench.backend.splat_project(cut_hierarchy(shot.tree, view, true), shot.tree.ridges, view));
  double naive_s = 0;
  NaiveSplats naive(bench.backend.session().info());
  const std::vector<Plane> other = naive.draw(splats, view, bench.repetitions(), naive_s);
  SplatPlanes own;
  const Timing timing =
      time_of(bench.repetitions(), [&] { own = bench.backend.splat_resolve(splats, view); });
  for (std::size_t k = 0; k < other[3].size(); ++k) {
    if (std::abs(other[3][k] - own.colour[3][k]) < 1e-3f) continue;
    fail(ErrorKind::internal, "naive splats give another picture: alpha {} for {}", other[3][k],
         own.colour[3][k]);
  }
  double fragments = 0;
  for (const float count : own.fragments) fragments += static_cast<double>(count);
  return fmt::format(
      "{}, {:.0f} mm, {} splats at {}x{}: {:.2f} M splats and {:.0f} M fragments a second "
      "(lists of tiles included), {:.1f} times what a work-item a splat and lists of fragments do.",
      shot.name, aperture_mm, splats.all.size(), side, side,
      1e-6 * static_cast<double>(splats.all.size()) / timing.median_s,
      1e-6 * fragments / timing.median_s, naive_s / timing.median_s);
}

}  // namespace

Figures measure_splat_speed(TableBench& b) {
  const Bench& bench = b.bench();
  Table table{"", "", {"points", "512×512, sharp", "500 mm", "1920×1080, sharp", "500 mm"}, {}};
  for (const std::size_t points : {81458, 1000000, 10000000}) {
    if (bench.is_quick && points > 100000) continue;
    const SplatShot shot = make_splat_shot("figure", 3.2, points);
    std::vector<std::string> row{std::to_string(points)};
    for (const auto& [width, height] : {std::pair{512, 512}, {1920, 1080}}) {
      for (const double aperture : {0.0, 500.0}) {
        const DefraySplatParams view =
            splat_view(shot, bench.size(width), bench.size(height), aperture);
        const SplatRun run = run_splats(bench, shot, view, true);
        row.push_back(fmt::format("{} ({:.0f}k splats, {:.1f}M fragments)", to_text(run.timing),
                                  static_cast<double>(run.report.drawn) / 1e3,
                                  run.report.fragments / 1e6));
      }
    }
    table.rows.push_back(std::move(row));
  }
  const SplatShot shot = make_splat_shot("figure", 3.2, 0);
  return {table, {against_naive(bench, shot, 0), against_naive(bench, shot, 500)}};
}

}  // namespace defray::perf
