// Error against time for every method and setting: what speed costs in accuracy.
#include "experiments.h"
#include "measure/metrics.h"
#include "measure/plot.h"
#include "truth/truth.h"

namespace defray::perf {
namespace {

struct Candidate {
  std::string series, label, options;
  MethodSettings settings;
};

std::vector<Candidate> candidates(bool is_quick) {
  std::vector<Candidate> all{{"linear", "", "--method linear", linear_of()}};
  for (const auto& [quality, word] : {std::pair{Quality::preview, "preview"},
                                      {Quality::draft, "draft"},
                                      {Quality::normal, "normal"},
                                      {Quality::high, "high"}}) {
    all.push_back({"RDB", word, fmt::format("--quality {}", word), default_chain(quality)});
  }
  for (const int n : {3, 5, 9, 17, 33}) {
    all.push_back({"RDB literal", fmt::format("{}x{}", n, n), fmt::format("--literal --rdb {}", n),
                   rdb_of(n)});
  }
  for (const auto& [kind, word] :
       {std::pair{GatherKind::literal, "literal"}, std::pair{GatherKind::aware, "aware"}}) {
    for (const int passes : {1, 2}) {
      for (const int samples : {8, 32, 128}) {
        all.push_back({fmt::format("gather {}, {} pass{}", word, passes, passes == 1 ? "" : "es"),
                       std::to_string(samples),
                       fmt::format("--method gather --gather {} --samples {} --passes {}", word,
                                   samples, passes),
                       gather_of(kind, samples, passes)});
      }
    }
  }
  if (is_quick) all.resize(5);
  return all;
}

struct TradePlace {
  std::string scene, setting;
};

void add_scene(const Bench& bench, const TradePlace& place, Section& section) {
  const int width = bench.size(640), height = bench.size(400), samples = bench.is_quick ? 16 : 256;
  bench.step(place.scene + ": truth");
  const Subject s =
      make_antialiased(bench.backend, make_scene(place.scene, width, height), place.setting);
  const Truth truth = render_truth(s.scene, s.lens, samples, 1);
  Table table{
      "tradeoff-" + place.scene,
      fmt::format("{}, {}: error and time. First: defray scene {} -o {} --width {} --height {} "
                  "--truth-samples {} --pinhole-samples {}",
                  place.scene, place.setting, place.scene, place.scene, width, height, samples,
                  pinhole_samples),
      {"method", "setting", "time", "PSNR sRGB dB", "PSNR linear dB", "SSIM", "command"},
      {}};
  Plot plot{place.scene + ": error against time", "seconds", "PSNR, sRGB, dB", true, false, {}};
  for (const Candidate& candidate : candidates(bench.is_quick)) {
    bench.step(place.scene + ": " + candidate.options);
    const Timing timing = time_method(bench, s, candidate.settings);
    const Comparison c =
        compare(render(bench.backend, s, candidate.settings), truth.colour, s.scene.width);
    table.rows.push_back(
        {candidate.series, candidate.label, to_text(timing), fixed(c.psnr_srgb_db),
         fixed(c.psnr_linear_db), fixed(c.ssim, 4),
         fmt::format("defray render {0}/pinhole.exr -o {0}/out.exr --camera {0}/camera.json "
                     "--focus-setting {1} {2}",
                     place.scene, place.setting, candidate.options)});
    if (plot.series.empty() || plot.series.back().name != candidate.series) {
      plot.series.push_back({candidate.series, {}, true, true});
    }
    plot.series.back().points.push_back({timing.median_s, c.psnr_srgb_db, candidate.label});
  }
  const Comparison none = compare(s.pinhole.colour, truth.colour, s.scene.width);
  table.rows.push_back({"pinhole", "", "", fixed(none.psnr_srgb_db), fixed(none.psnr_linear_db),
                        fixed(none.ssim, 4), ""});
  if (truth.noise) {
    section.findings.push_back(fmt::format(
        "{}: the truth's two halves are {:.1f} dB apart, so no figure near {:.0f} dB means much.",
        place.scene, truth.noise->psnr_srgb_db, truth.noise->psnr_srgb_db + 6));
  }
  const std::string file = "tradeoff-" + place.scene + ".png";
  write_plot(bench.folder + "/" + file, plot);
  section.tables.push_back(table);
  section.figures.push_back({file, "Up and to the left is better. " + place.scene});
}

}  // namespace

Section tradeoff(const Bench& bench) {
  Section section{
      "Error against time",
      "Every method and setting on three scenes, times of CoC and method without reading "
      "and writing files. Each point's command stands beside it.",
      {},
      {},
      {}};
  for (const TradePlace& place : {TradePlace{"fence", "bg"}, TradePlace{"spheres", "f5"},
                                  TradePlace{"blocks-forest", "miniature"}}) {
    add_scene(bench, place, section);
  }
  return section;
}

}  // namespace defray::perf
