// Expected and true errors: of built-in and random scenes, and of ray-traced ones where they are
// given, which never set the model.
#include "experiments.h"
#include "prediction/renders.h"
#include "tables/tables.h"
#include "truth/places.h"

namespace defray::perf {

Figures measure_prediction(TableBench& b) {
  const Section section = experiments().at("prediction").run(b.bench());
  Figures figures{section.tables[0], {}};
  std::vector<PredictedRender> given;
  for (const MeasuredPlace& place : read_places(b.bench())) {
    b.bench().step(place.name);
    std::string note = place.name + ", true and expected:";
    for (PredictedRender& r :
         predicted_renders(b.bench().backend, place.subject, {place.truth, place.truth})) {
      note +=
          fmt::format(" {} {:.1f}, {:.1f};", to_string(r.quality), r.true_db(), r.expected.psnr_db);
      given.push_back(std::move(r));
    }
    note.back() = '.';
    figures.notes.push_back(note);
  }
  if (given.empty()) return figures;
  std::vector<const PredictedRender*> chosen;
  for (const PredictedRender& r : given) chosen.push_back(&r);
  std::vector<std::string> row = prediction_row(chosen);
  row.insert(row.begin(), "are of other scenes");
  figures.table.rows.push_back(row);
  return figures;
}

}  // namespace defray::perf
