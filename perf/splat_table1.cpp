// Krivanek & Zara 2003, table 1 and figure 6: time and error of point clouds against aperture, with
// and without levels of detail, beside the mean of 200 sharp views.
#include <cmath>

#include "base/error.h"
#include "experiments.h"
#include "measure/metrics.h"
#include "splat/hierarchy.h"
#include "splat/splat_picture.h"
#include "splat/surfels.h"
#include "splat/view.h"

namespace defray::perf {
namespace {

constexpr int views = 200;

/// A model before the camera, and lenses that blur it as the paper's did: fragments a splat.
struct Shot {
  std::string name;
  double distance;                   ///< Scene units, along z.
  std::vector<double> apertures_mm;  ///< 0 first.
};

const std::vector<Shot>& shots() {
  static const std::vector<Shot> all{{"plane", 3.2, {0, 225, 900}},
                                     {"figure", 3.2, {0, 300, 1200}}};
  return all;
}

struct Model {
  Shot shot;
  Hierarchy tree;
  std::size_t side;  ///< Of the picture, px.
};

Model make_model(const Bench& bench, const Shot& shot) {
  PointCloud cloud = make_point_cloud(shot.name, bench.is_quick ? 10000 : 0);
  return {shot, build_hierarchy(make_surfels(cloud).points, true), size(bench.size(512))};
}

DefraySplatParams params_of(const Model& model, double aperture_mm, SplatMerge merge,
                            SplatPsf psf = SplatPsf::gaussian) {
  CameraPose pose;
  pose.from = {0, 0, model.shot.distance};
  Lens lens;
  lens.aperture_diameter_mm = aperture_mm;
  lens.focus_distance_units = model.shot.distance;
  SplatSettings settings;
  settings.width = settings.height = static_cast<int>(model.side);
  settings.merge = merge;
  settings.psf = psf;
  DefraySplatParams p = splat_params(pose, {}, lens, settings);
  p.one_sided = 1;
  return p;
}

/// One way of drawing, measured.
struct Row {
  SplatReport report;
  Timing timing;
  std::vector<Plane> picture;
};

/// Throws Error(internal) where a picture is not that of the run before.
Row measure(const Bench& bench, const Model& model, const DefraySplatParams& params, bool lod) {
  Row row;
  bool repeats = true;
  row.timing = time_of(bench.repetitions(), [&] {
    row.report = {};
    SplatPlanes planes = draw_splats(bench.backend, model.tree, params, lod, 0, row.report);
    repeats = repeats && (row.picture.empty() || row.picture == planes.colour);
    row.picture = std::move(planes.colour);
  });
  if (!repeats) fail(ErrorKind::internal, "a timed picture differs from run to run");
  return row;
}

std::string psnr(const std::vector<Plane>& a, const std::vector<Plane>& b, std::size_t side) {
  return fixed(compare(a, b, static_cast<int>(side)).psnr_srgb_db);
}

/// What the findings are about, of one model.
struct Ratios {
  double sharp_s = 0, lod_s = 0, points_s = 0, views_s = 0;
};

Ratios add_rows(const Bench& bench, const Model& model, Table& table, Section& section) {
  Ratios r;
  for (const double aperture : model.shot.apertures_mm) {
    bench.step(fmt::format("{}, aperture {} mm", model.shot.name, aperture));
    const DefraySplatParams params = params_of(model, aperture, SplatMerge::nearest);
    std::vector<Plane> truth;
    const double truth_s =
        seconds_of([&] { truth = mean_of_views(bench.backend, model.tree, params, views); });
    const std::vector<Plane> average =
        measure(bench, model, params_of(model, aperture, SplatMerge::average), true).picture;
    const Row discs = measure(
        bench, model, params_of(model, aperture, SplatMerge::nearest, SplatPsf::disc), true);
    for (const bool lod : {true, false}) {
      const Row row = measure(bench, model, params, lod);
      table.rows.push_back({model.shot.name, fixed(aperture, 0), lod ? "on" : "off",
                            fmt::format("{:.0f}", row.report.fragments / 1000),
                            std::to_string(row.report.drawn), to_text(row.timing),
                            psnr(row.picture, truth, model.side),
                            lod ? psnr(average, truth, model.side) : "",
                            lod ? psnr(discs.picture, truth, model.side) : "",
                            lod ? to_text(discs.timing) : "", fixed(truth_s)});
      (lod ? r.lod_s : r.points_s) = row.timing.median_s;
      if (aperture == 0 && lod) r.sharp_s = row.timing.median_s;
      r.views_s = truth_s;
      if (!lod || aperture == 0) continue;
      const std::string name = fmt::format("splat_{}_{:.0f}", model.shot.name, aperture);
      section.figures.push_back(sheet(
          bench, name, fmt::format("{}, {:.0f} mm: splats, 200 views", model.shot.name, aperture),
          {{"splats", &row.picture}, {"discs", &discs.picture}, {"200 views", &truth}}, static_cast<int>(model.side),
          static_cast<int>(model.side)));
    }
  }
  return r;
}

}  // namespace

Section splat_table1(const Bench& bench) {
  Section section{
      "Splatting, table 1: time against aperture",
      "Krivanek & Zara 2003: at the largest aperture the plane takes 0.75 s with levels "
      "of detail, 0.76 s sharp, 20.2 s without them, and 147 s as the mean of 200 views.",
      {},
      {},
      {}};
  Table table{"splat_table1",
              fmt::format("{0}x{0}, c = 2.5; PSNR against {1} views, dB, sRGB-encoded",
                          bench.size(512), views),
              {"model", "aperture, mm", "LOD", "fragments, 1000", "splats", "time", "PSNR",
               "PSNR, averaged", "PSNR, discs", "time, discs", "200 views, s"},
              {}};
  for (const Shot& shot : shots()) {
    const Ratios r = add_rows(bench, make_model(bench, shot), table, section);
    section.findings.push_back(fmt::format(
        "{}, largest aperture: {:.2f} times the sharp picture's time (paper {}); without levels of "
        "detail {:.1f} times as long (paper {}); 200 views {:.0f} times as long (paper {}).",
        shot.name, r.lod_s / r.sharp_s, shot.name == "plane" ? "0.99" : "1.30",
        r.points_s / r.lod_s, shot.name == "plane" ? "26.9" : "15.9", r.views_s / r.lod_s,
        shot.name == "plane" ? "196" : "148"));
  }
  section.tables.push_back(table);
  return section;
}

}  // namespace defray::perf
