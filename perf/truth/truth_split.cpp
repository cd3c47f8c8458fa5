// What is left of the error: the default chain with more and more of what it must guess given to
// it, from the scene.
#include "chain/plan/ray_plan.h"
#include "chain/steps/highlights.h"
#include "truth/truth_exact.h"

namespace defray::perf {
namespace {

std::vector<Plane> cropped(const Wide& w, const std::vector<Plane>& planes) {
  const Scene& inner = w.setup.subject.scene;
  std::vector<Plane> out(planes.size());
  for (std::size_t c = 0; c < planes.size(); ++c) {
    for (int y = 0; y < inner.height; ++y) {
      const auto row = planes[c].begin() +
                       static_cast<std::ptrdiff_t>(y + w.margin) * w.subject.scene.width + w.margin;
      out[c].insert(out[c].end(), row, row + inner.width);
    }
  }
  return out;
}

/// The rest of the chain.
std::vector<Plane> distributed(const Bench& bench, Frame f, int cells_per_side) {
  ChainSettings settings;
  settings.cells_per_side = cells_per_side;
  const RayPlan plan = ray_plan(settings, false);
  const int points = static_cast<int>(plan.lens.points.size());
  const LightSources lights =
      take_light(f, bench.backend.highlights(f, 3), 3, make_aperture_table(rasterise({})));
  f.channels = bench.backend.soften(f, points);
  return bench.backend.rays(f, plan, &lights).means;
}

}  // namespace

void add_split(const Bench& bench, const std::vector<Setup>& setups, Section& section) {
  Table table{
      "truth-split",
      "What is left. PSNR against the truth, sRGB, dB, as more and more is known. Overscan: "
      "what lies around the frame is in the picture",
      {"known"},
      {{"default"},
       {"+ overscan"},
       {"+ exact hidden surfaces"},
       {"+ exact coverage of edge pixels"},
       {"+ 33x33 cells"},
       {"+ 64x64 cells"},
       {"truth itself, about"}}};
  for (const Setup& setup : setups) {
    bench.step(setup.name() + ": what is left");
    table.columns.push_back(setup.name());
    const Wide w = make_wide(bench, setup);
    std::size_t row = 0;
    const auto add = [&](double db) { table.rows[row++].push_back(fixed(db)); };
    const auto add_wide = [&](const std::vector<Plane>& picture) {
      add(setup.psnr_db(cropped(w, picture)));
    };
    add(setup.psnr_db(render(bench.backend, setup.subject, default_chain())));
    add_wide(render(bench.backend, w.subject, default_chain()));
    add_wide(distributed(bench, split_surfaces(bench, w), 13));
    const Frame exact = exact_surfaces(bench, w);
    add_wide(distributed(bench, exact, 13));
    add_wide(distributed(bench, exact, 33));
    add_wide(distributed(bench, exact, bench.is_quick ? 17 : 64));
    add(setup.truth_db());
  }
  section.tables.push_back(table);
}

}  // namespace defray::perf
