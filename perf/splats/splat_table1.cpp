// Krivanek & Zara 2003, table 1 and figure 6: time and error of point clouds against aperture, with
// and without levels of detail, beside the mean of 200 sharp views.
#include "base/median.h"
#include "experiments.h"
#include "measure/metrics.h"
#include "splats/splat_shots.h"
#include "tables/tables.h"

namespace defray::perf {
namespace {

int views(const Bench& bench) { return bench.is_quick ? 20 : 200; }

/// The paper's models, and lenses that blur them at least as its own did (fragments a splat); what
/// it says of the largest: time over the sharp picture's, without levels of detail over with, views
/// over that.
struct PaperRow {
  const char* model;
  std::vector<double> apertures_mm;  ///< 0 first.
  const char *sharp, *points, *views;
};

const std::vector<PaperRow>& rows() {
  static const std::vector<PaperRow> all{{"plane", {0, 225, 900, 1600}, "0.99", "26.9", "196"},
                                         {"figure", {0, 300, 1200, 1600}, "1.30", "15.9", "148"},
                                         {"crossing", {0, 300}, "", "", ""}};
  return all;
}

/// All that is drawn through one aperture.
struct Pictures {
  SplatRun lod, points, gaussians;
  std::vector<Plane> truth, multisampled;
  double truth_s = 0;
};

/// The means of 2x2 pixels of pictures twice as wide.
std::vector<Plane> halved(const std::vector<Plane>& planes, int width) {
  std::vector<Plane> out;
  for (const Plane& plane : planes) {
    Plane& half = out.emplace_back(plane.size() / 4);
    const std::size_t across = size(width);
    for (std::size_t i = 0; i < half.size(); ++i) {
      const float* const at = &plane[i / across * 4 * across + i % across * 2];
      half[i] = (at[0] + at[1] + at[2 * across] + at[2 * across + 1]) / 4;
    }
  }
  return out;
}

Pictures draw(const Bench& bench, const SplatShot& shot, double aperture_mm) {
  const auto view = [&](const SplatSettings& settings) {
    return splat_view(shot, bench.size(512), bench.size(512), aperture_mm, settings);
  };
  SplatSettings gaussians;
  gaussians.psf = SplatPsf::gaussian;
  Pictures p;
  p.truth_s = seconds_of(
      [&] { p.truth = mean_of_views(bench.backend, {&shot.tree}, view({}), views(bench)); });
  p.multisampled =
      halved(mean_of_views(bench.backend, {&shot.tree},
                           splat_view(shot, 2 * bench.size(512), 2 * bench.size(512), aperture_mm),
                           views(bench)),
             bench.size(512));
  p.lod = run_splats(bench, shot, view({}), true);
  p.points = run_splats(bench, shot, view({}), false);
  p.gaussians = run_splats(bench, shot, view(gaussians), true);
  return p;
}

void add_row(const Bench& bench, const SplatShot& shot, double aperture_mm, const Pictures& p,
             Table& table) {
  const auto psnr_to = [&](const std::vector<Plane>& truth, const SplatRun& run) {
    return fixed(compare(run.picture, truth, bench.size(512)).psnr_srgb_db);
  };
  const auto psnr = [&](const SplatRun& run) { return psnr_to(p.truth, run); };
  const auto count = [](const SplatRun& run) {
    return fmt::format("{:.1f}M, {}k", run.report.fragments / 1e6, run.report.drawn / 1000);
  };
  table.rows.push_back({shot.name, fixed(aperture_mm, 0), to_text(p.lod.timing), count(p.lod),
                        to_text(p.points.timing), count(p.points), fixed(p.truth_s, 1) + " s",
                        psnr(p.lod), psnr(p.points), psnr_to(p.multisampled, p.lod),
                        to_text(p.gaussians.timing), psnr(p.gaussians)});
}

/// What the largest aperture comes to, each beside the paper's.
Table ratios(const Bench& bench) {
  return {"splat_ratios",
          "Times at the largest aperture, and in brackets the paper's",
          {"model", "time ÷ sharp", "every point ÷ levels of detail",
           fmt::format("mean of {} sharp views ÷ one picture", views(bench)), "PSNR to it"},
          {}};
}

/// Of so many pairs of a sharp and a blurred picture, drawn by turns: between other things' times
/// the machine's speed changes more than these differ.
constexpr int pairs = 41;

/// Time at the largest aperture over that of a sharp picture: the median of the pairs'.
double blurred_to_sharp(const Bench& bench, const SplatShot& shot, double aperture_mm) {
  const auto time = [&](double aperture) {
    const DefraySplatParams view = splat_view(shot, bench.size(512), bench.size(512), aperture);
    SplatReport ignored;
    return seconds_of([&] { draw_splats(bench.backend, shot.tree, view, true, 0, ignored); });
  };
  std::vector<double> ratios;
  for (int i = 0; i < pairs; ++i) {
    const double sharp = time(0);
    ratios.push_back(time(aperture_mm) / sharp);
  }
  return median(ratios);
}

void add_ratios(const Bench& bench, const PaperRow& row, const SplatShot& shot,
                const Pictures& blurred, Table& table) {
  const double lod = blurred.lod.timing.median_s;
  const auto beside = [](double ratio, int digits, const char* paper) {
    return fmt::format("{:.{}f} ({})", ratio, digits, paper);
  };
  table.rows.push_back(
      {row.model, beside(blurred_to_sharp(bench, shot, row.apertures_mm.back()), 2, row.sharp),
       beside(blurred.points.timing.median_s / lod, 1, row.points),
       beside(blurred.truth_s / lod, 0, row.views),
       fmt::format(
           "{}, Gaussians {}",
           fixed(compare(blurred.lod.picture, blurred.truth, bench.size(512)).psnr_srgb_db, 1),
           fixed(compare(blurred.gaussians.picture, blurred.truth, bench.size(512)).psnr_srgb_db,
                 1))});
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
                          bench.size(512), views(bench)),
              {"model", "aperture, mm", "time", "fragments, splats", "LOD off", "fragments, splats",
               "200 views", "PSNR", "LOD off", "to 2×2 samples", "Gaussians", "PSNR"},
              {}};
  Table largest = ratios(bench);
  for (const PaperRow& row : rows()) {
    const SplatShot shot = make_splat_shot(row.model, 3.2, bench.is_quick ? 10000 : 0);
    Pictures last;
    for (const double aperture : row.apertures_mm) {
      bench.step(fmt::format("{}, aperture {} mm", row.model, aperture));
      const Pictures& p = last = draw(bench, shot, aperture);
      add_row(bench, shot, aperture, p, table);
      if (aperture == 0) continue;
      section.figures.push_back(sheet(
          bench, fmt::format("splat_{}_{:.0f}", row.model, aperture),
          fmt::format("{}, {:.0f} mm: discs, Gaussians, {} views", row.model, aperture,
                      views(bench)),
          {{"discs", &p.lod.picture}, {"Gaussians", &p.gaussians.picture}, {"views", &p.truth}},
          bench.size(512), bench.size(512)));
    }
    if (*row.sharp) add_ratios(bench, row, shot, last, largest);
  }
  section.tables = {table, largest};
  return section;
}

Figures measure_splats(TableBench& b) { return {b.splats().tables[0], {}}; }

Figures measure_splat_ratios(TableBench& b) { return {b.splats().tables[1], {}}; }

}  // namespace defray::perf
