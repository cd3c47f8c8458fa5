// Each stage around the RDB, left out or chosen otherwise: PSNR and time.
#include <algorithm>

#include "base/error.h"
#include "truth/truth.h"

namespace defray::perf {
namespace {

struct Variant {
  std::string name;
  MethodSettings settings;
  bool averages_depth = false;
};

/// The default but for one change.
Variant with(const std::string& name, const std::function<void(ChainSettings&)>& change,
             bool averages_depth = false) {
  Variant v{name, default_chain(), averages_depth};
  change(*v.settings.chain);
  return v;
}

constexpr std::size_t default_at = 1;  ///< In variants().

std::vector<Variant> variants() {
  return {{"literal RDB 9x9", rdb_of(9)},
          {"default", default_chain()},
          with("--hidden off", [](auto& d) { d.hidden = Hidden::off; }),
          with("--hidden fill", [](auto& d) { d.hidden = Hidden::fill; }),
          with("--split off", [](auto& d) { d.split = false; }),
          with("--highlights rays", [](auto& d) { d.highlights = false; }),
          with("colours not softened", [](auto& d) { d.soften = false; }),
          with("--sparse off", [](auto& d) { d.sparse = false; }),
          with("--border renormalise", [](auto& d) { d.border = Border::renormalise; }),
          with("--border black", [](auto& d) { d.border = Border::black; }),
          with("--repair off", [](auto& d) { d.repair = false; }),
          with(
              "anti-aliased depth", [](auto&) {}, true),
          with(
              "anti-aliased depth, --repair off", [](auto& d) { d.repair = false; }, true),
          {"--quality preview", default_chain(Quality::preview)},
          {"--quality draft", default_chain(Quality::draft)},
          {"--quality high", default_chain(Quality::high)}};
}

/// All variants once a round, so that what disturbs the machine disturbs them alike.
struct Paired {
  std::vector<std::vector<double>> seconds;  ///< [variant][round]
  std::vector<std::vector<Plane>> pictures;
};

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return (values[(values.size() - 1) / 2] + values[values.size() / 2]) / 2;
}

/// Median and spread of a variant's times in units of the default's in the same round.
Timing ratio(const Paired& p, std::size_t variant) {
  std::vector<double> ratios;
  for (std::size_t round = 0; round < p.seconds[variant].size(); ++round) {
    ratios.push_back(p.seconds[variant][round] / p.seconds[default_at][round]);
  }
  const auto [least, most] = std::minmax_element(ratios.begin(), ratios.end());
  return {median(ratios), (*most - *least) / median(ratios)};
}

Paired run(const Bench& bench, const Setup& setup, const std::vector<Variant>& all) {
  const Subject& s = setup.subject;
  const Subject filtered = make_antialiased(
      bench.backend, make_scene(setup.scene, s.scene.width, s.scene.height), setup.setting, true);
  Paired p;
  p.seconds.resize(all.size());
  for (int round = -1; round < (bench.is_quick ? 1 : 3); ++round) {  // -1: the picture
    for (std::size_t v = 0; v < all.size(); ++v) {
      bench.step(fmt::format("{}: {}, round {}", setup.name(), all[v].name, round + 1));
      std::vector<Plane> picture;
      const double seconds = seconds_of([&] {
        picture = render(bench.backend, all[v].averages_depth ? filtered : s, all[v].settings);
      });
      if (round < 0) {
        p.pictures.push_back(std::move(picture));
        continue;
      }
      p.seconds[v].push_back(seconds);
      if (picture != p.pictures[v]) fail(ErrorKind::internal, "a picture differs from run to run");
    }
  }
  return p;
}

std::string signed_db(double db) { return fmt::format("{:+.2f}", db); }

}  // namespace

void add_mechanisms(const Bench& bench, const std::vector<Setup>& setups, Section& section) {
  const std::vector<Variant> all = variants();
  const Scene& scene = setups[0].subject.scene;
  Table quality{
      "truth-mechanisms",
      fmt::format("PSNR against the truth, sRGB, dB, {} x {}, pinhole of {} rays a pixel; for a "
                  "change of the default the difference to the default",
                  scene.width, scene.height, pinhole_samples),
      {"method"},
      {}};
  Table cost{"truth-cost",
             "Time in units of the default's in the same round: median, and (largest - smallest) "
             "/ median",
             {"method"},
             {}};
  quality.rows = {{"pinhole"}, {"truth itself, about"}};
  cost.rows = {{"default, seconds"}};
  for (const Variant& v : all) {
    quality.rows.push_back({v.name});
    cost.rows.push_back({v.name});
  }
  double least_spread = 1e9, largest_spread = 0;
  for (const Setup& setup : setups) {
    check_against_twin(bench.backend, setup.subject, default_chain());
    const Paired p = run(bench, setup, all);
    quality.columns.push_back(setup.name());
    cost.columns.push_back(setup.name());
    quality.rows[0].push_back(fixed(setup.psnr_db(setup.subject.pinhole.colour)));
    quality.rows[1].push_back(fixed(setup.truth_db()));
    cost.rows[0].push_back(fixed(median(p.seconds[default_at]), 3));
    const double default_db = setup.psnr_db(p.pictures[default_at]);
    for (std::size_t v = 0; v < all.size(); ++v) {
      const double db = setup.psnr_db(p.pictures[v]);
      quality.rows[v + 2].push_back(v <= default_at ? fixed(db) : signed_db(db - default_db));
      const Timing t = ratio(p, v);
      cost.rows[v + 1].push_back(fmt::format("{:.2f} ± {:.0f} %", t.median_s, 100 * t.spread));
      if (v == default_at) continue;
      least_spread = std::min(least_spread, t.spread);
      largest_spread = std::max(largest_spread, t.spread);
    }
    section.findings.push_back(
        fmt::format("{}: literal {:.2f} dB, default {:.2f} dB; truth's own "
                    "noise is at about {:.1f} dB.",
                    setup.name(), setup.psnr_db(p.pictures[0]), default_db, setup.truth_db()));
  }
  section.findings.push_back(fmt::format("Ratios of times spread by {:.0f} to {:.0f} %.",
                                         100 * least_spread, 100 * largest_spread));
  section.tables.push_back(quality);
  section.tables.push_back(cost);
}

}  // namespace defray::perf
