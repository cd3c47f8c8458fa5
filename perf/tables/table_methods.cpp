// Error and time of every method: on built-in scenes, and on ray-traced ones where they are given.
#include "measure/metrics.h"
#include "tables/tables.h"
#include "truth/places.h"

namespace defray::perf {
namespace {

struct Row {
  std::string name;
  MethodSettings settings;
};

std::vector<Row> rows(bool is_quick) {
  std::vector<Row> all{{"rdb `--quality preview`", default_chain(Quality::preview)},
                       {"rdb `--quality draft`", default_chain(Quality::draft)},
                       {"rdb (default)", default_chain()},
                       {"rdb `--quality high`", default_chain(Quality::high)},
                       {"rdb `--literal`, 9×9", rdb_of(9)},
                       {"rdb `--literal`, 33×33", rdb_of(33)},
                       {"linear", linear_of()},
                       {"gather literal, 32 samples × 2", gather_of(GatherKind::literal, 32, 2)},
                       {"gather aware, 32 samples × 2", gather_of(GatherKind::aware, 32, 2)},
                       {"gather aware, 128 samples × 2", gather_of(GatherKind::aware, 128, 2)}};
  if (is_quick) all = {all[0], all[2], all[4], all[6], all[8]};  // the fast ones
  return all;
}

Table table_of(const Bench& bench, const std::vector<MeasuredPlace>& places, int repetitions) {
  const std::vector<Row> all = rows(bench.is_quick);
  Table table{"", "", {"method"}, {{"pinhole"}}};
  for (const Row& row : all) table.rows.push_back({row.name});
  for (const MeasuredPlace& place : places) {
    const auto psnr = [&](const std::vector<Plane>& picture) {
      return compare(picture, place.truth, place.subject.scene.width).psnr_srgb_db;
    };
    table.columns.push_back(place.name);
    table.rows[0].push_back(fixed(psnr(place.subject.pinhole.colour)));
    for (std::size_t i = 0; i < all.size(); ++i) {
      bench.step(place.name + ": " + all[i].name);
      check_against_twin(bench.backend, place.subject, all[i].settings);
      std::vector<Plane> picture;
      const Timing time = time_of(
          repetitions, [&] { picture = render(bench.backend, place.subject, all[i].settings); });
      table.rows[i + 1].push_back(fmt::format("{:.2f} ({:.2f} s)", psnr(picture), time.median_s));
    }
  }
  return table;
}

/// As 'defray scene plate1 --truth-samples 1024' writes it.
MeasuredPlace plate1_place(const Bench& bench) {
  bench.step("plate1: truth");
  Subject s = make_subject(bench.backend, make_scene("plate1", bench.size(640), bench.size(480)),
                           "default");
  s.pinhole.colour = render_pinhole(s.scene, {16}).colour;
  auto truth = render_truth(s.scene, s.lens, bench.is_quick ? 16 : 1024, 1).colour;
  return {"plate1", std::move(s), std::move(truth)};
}

}  // namespace

Figures measure_accuracy(TableBench& b) {
  std::vector<MeasuredPlace> places;
  places.push_back(plate1_place(b.bench()));
  for (MeasuredPlace& place : read_places(b.bench())) {
    places.push_back(std::move(place));
  }
  return {table_of(b.bench(), places, 1), {}};
}

Figures measure_methods(TableBench& b) {
  const Bench& bench = b.bench();
  std::vector<MeasuredPlace> places;
  for (const auto& [scene, setting] :
       {std::pair{"fence", "bg"}, {"spheres", "f5"}, {"blocks-forest", "miniature"}}) {
    bench.step(fmt::format("{}: truth", scene));
    Subject s = make_antialiased(bench.backend, make_scene(scene, bench.size(640), bench.size(400)),
                                 setting);
    auto truth = render_truth(s.scene, s.lens, bench.is_quick ? 16 : 256, 1).colour;
    places.push_back({fmt::format("{} {}", scene, setting), std::move(s), std::move(truth)});
  }
  return {table_of(bench, places, bench.is_quick ? 1 : 3), {}};
}

}  // namespace defray::perf
