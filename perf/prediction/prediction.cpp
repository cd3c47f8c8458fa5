// Errors that are expected beside true ones: how well a render knows how wrong it is.
#include <functional>

#include "base/text.h"
#include "experiments.h"
#include "image/safe_output.h"
#include "measure/plot.h"
#include "prediction/renders.h"

namespace defray::perf {
namespace {

/// For perf/scripts/fit_prediction.py.
void write_signs(const std::string& path, const std::vector<PredictedRender>& renders) {
  std::string text = "render,use,true square";
  for (const std::string& name : sign_names()) text += ",\"" + name + "\"";
  text += "\n";
  for (const PredictedRender& r : renders) {
    text += fmt::format("\"{}, {}, {}\",{},{}", r.scene, r.width, to_string(r.quality),
                        r.sets_model ? "set" : "test", r.true_square);
    for (const double sign : r.signs) text += fmt::format(",{}", sign);
    text += "\n";
  }
  write_text(path, text);
}

Plot scatter(const std::vector<PredictedRender>& renders) {
  Plot plot{
      "Expected and true error", "true PSNR, sRGB, dB", "expected PSNR, dB", false, false, {}};
  Series set{"sets the model", {}, false, true}, tests{"tests it", {}, false, true};
  for (const PredictedRender& r : renders) {
    (r.sets_model ? set : tests).points.push_back({r.true_db(), r.expected.psnr_db});
  }
  plot.series = {set, tests, {"equal", {{20, 20}, {70, 70}}, true, false}};
  return plot;
}

}  // namespace

Section prediction(const Bench& bench) {
  Section section{"Predicted error",
                  "A render says how far from the truth it expects to be. How far is it from that?",
                  {},
                  {},
                  {}};
  const std::vector<PredictedRender> renders = all_predicted_renders(bench);
  write_signs(bench.folder + "/prediction.csv", renders);
  Table table{"prediction-summary", "Expected less true PSNR, dB", {"renders that"}, {}};
  const std::vector<std::string> columns = prediction_columns();
  table.columns.insert(table.columns.end(), columns.begin(), columns.end());
  const auto add = [&](const std::string& name,
                       const std::function<bool(const PredictedRender&)>& counts) {
    std::vector<const PredictedRender*> chosen;
    for (const PredictedRender& r : renders) {
      if (counts(r)) chosen.push_back(&r);
    }
    std::vector<std::string> row = prediction_row(chosen);
    row.insert(row.begin(), name);
    table.rows.push_back(row);
  };
  add("set the model", [](const PredictedRender& r) { return r.sets_model; });
  add("test it", [](const PredictedRender& r) { return !r.sets_model; });
  for (const Quality quality : all_qualities) {
    add(fmt::format("test it, {}", to_string(quality)),
        [quality](const PredictedRender& r) { return !r.sets_model && r.quality == quality; });
  }
  for (const auto& row : {table.rows[0], table.rows[1]}) {
    section.findings.push_back(
        fmt::format("{} renders that {}: expected PSNR is off by {} dB (median), nine in ten by at "
                    "most {} dB; {} lie inside the interval; rank correlation of pixels {}.",
                    row[1], row[0], row[3], row[4], row[5], row[6]));
  }
  section.tables.push_back(table);
  write_plot(bench.folder + "/prediction.png", scatter(renders));
  section.figures.push_back({"prediction.png", "On the line: as expected."});
  return section;
}

}  // namespace defray::perf
