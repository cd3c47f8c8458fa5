// Random layers: how often, and by how much, is another method closer to the truth than the
// default?
#include <algorithm>
#include <array>
#include <cmath>

#include "experiments.h"
#include "random/layered_scene.h"
#include "truth/truth.h"
#include "truth/two_truths.h"

namespace defray::perf {
namespace {

/// Closer than this is as close: a hundredth of what 8 bits can show.
constexpr double most_db = 60, tie_db = 0.05;

struct Rival {
  const char* name;
  MethodSettings settings;
};

const std::vector<Rival>& rivals() {
  static const std::vector<Rival> all{
      {"literal RDB 9x9", rdb_of(9)},
      {"gather literal 32x2", gather_of(GatherKind::literal, 32, 2)},
      {"gather aware 32x2", gather_of(GatherKind::aware, 32, 2)}};
  return all;
}

/// PSNR of the default, and what it has more than each rival, dB.
struct Measured {
  std::uint32_t seed = 0;
  double own_db = 0;
  std::vector<double> gain_db;

  double least_gain_db() const { return *std::min_element(gain_db.begin(), gain_db.end()); }
};

struct Layers {
  const Bench& bench;
  int rays;

  Subject subject(std::uint32_t seed) const {
    return make_antialiased(bench.backend, layered_scene(bench.size(320), bench.size(208), seed),
                            "layered");
  }

  Measured measure(std::uint32_t seed) const {
    bench.step(fmt::format("scene {}", seed));
    const Subject s = subject(seed);
    const TwoTruths truths = make_two_truths(s, rays);
    const auto psnr_db = [&](const MethodSettings& settings) {
      const auto picture = render(bench.backend, s, settings);
      return std::min(psnr_of(mean_of(square_errors(picture, truths))), most_db);
    };
    Measured m{seed, psnr_db(default_chain()), {}};
    for (const Rival& rival : rivals()) m.gain_db.push_back(m.own_db - psnr_db(rival.settings));
    return m;
  }
};

Table summary(const std::vector<Measured>& all) {
  Table table{"layered",
              fmt::format("{} random scenes: what the default has more than others, PSNR in dB",
                          all.size()),
              {"method", "median", "worst", fmt::format("closer by more than {} dB in", tie_db)},
              {}};
  for (std::size_t k = 0; k < rivals().size(); ++k) {
    std::vector<double> gains;
    for (const Measured& m : all) gains.push_back(m.gain_db[k]);
    std::sort(gains.begin(), gains.end());
    const auto losses =
        std::count_if(gains.begin(), gains.end(), [&](double g) { return g < -tie_db; });
    table.rows.push_back({rivals()[k].name, fixed(gains[gains.size() / 2]), fixed(gains.front()),
                          fmt::format("{}", losses)});
  }
  return table;
}

Table worst(const std::vector<Measured>& all) {
  Table table{"layered-worst", "Where the others do best", {"scene", "default, dB"}, {}};
  for (const Rival& rival : rivals()) {
    table.columns.push_back(std::string("more than ") + rival.name);
  }
  for (std::size_t i = 0; i < std::min<std::size_t>(all.size(), 20); ++i) {
    table.rows.push_back({std::to_string(all[i].seed), fixed(all[i].own_db)});
    for (const double gain : all[i].gain_db) table.rows.back().push_back(fixed(gain));
  }
  return table;
}

Figure picture(const Layers& layers, std::uint32_t seed) {
  const Bench& bench = layers.bench;
  const Subject s = layers.subject(seed);
  const std::vector<Plane> truth = render_truth(s.scene, s.lens, layers.rays, 1).colour;
  const auto own = render(bench.backend, s, default_chain());
  const auto aware = render(bench.backend, s, rivals().back().settings);
  const auto difference = difference_picture(own, truth, 4);
  return sheet(bench, fmt::format("layered-{}", seed),
               fmt::format("scene {}; last: 4 times the difference of sRGB values", seed),
               {{"pinhole", &s.pinhole.colour},
                {rivals().back().name, &aware},
                {"default", &own},
                {"truth", &truth},
                {"default against truth", &difference}},
               s.scene.width, s.scene.height);
}

}  // namespace

Section layered(const Bench& bench) {
  Section section{"Random layers",
                  "Two to four flat layers at random depths, of random textures, one in five of "
                  "them noise. Is the default ever farther from the truth than a method without "
                  "its stages?",
                  {},
                  {},
                  {}};
  const Layers layers{bench, bench.is_quick ? 4 : 64};
  std::vector<Measured> all;
  for (std::uint32_t seed = 1; seed <= (bench.is_quick ? 3u : 200u); ++seed) {
    all.push_back(layers.measure(seed));
  }
  std::sort(all.begin(), all.end(), [](const Measured& a, const Measured& b) {
    return a.least_gain_db() < b.least_gain_db();
  });
  section.tables = {summary(all), worst(all)};
  const auto losses = std::count_if(all.begin(), all.end(),
                                    [](const Measured& m) { return m.least_gain_db() < -tie_db; });
  section.findings.push_back(
      fmt::format("In {} of {} scenes another method is closer by more than {} dB.", losses,
                  all.size(), tie_db));
  for (std::size_t i = 0; i < 3; ++i) section.figures.push_back(picture(layers, all[i].seed));
  return section;
}

}  // namespace defray::perf
