#include "prediction/renders.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "random/random_scene.h"
#include "truth/truth.h"

namespace defray::perf {
namespace {

/// Places in ascending order, 0 to count - 1.
std::vector<double> ranks(const Plane& values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  std::vector<double> out(values.size());
  for (std::size_t i = 0; i < order.size();) {
    std::size_t end = i;  // of equal values, which share their mean place
    while (end < order.size() && values[order[end]] == values[order[i]]) ++end;
    for (std::size_t k = i; k < end; ++k) {
      out[order[k]] = static_cast<double>(i + end - 1) / 2;
    }
    i = end;
  }
  return out;
}

/// Spearman's.
double rank_correlation(const Plane& a, const Plane& b) {
  const std::vector<double> x = ranks(a), y = ranks(b);
  const double mean = static_cast<double>(a.size() - 1) / 2;
  double xy = 0, xx = 0, yy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    xy += (x[i] - mean) * (y[i] - mean);
    xx += (x[i] - mean) * (x[i] - mean);
    yy += (y[i] - mean) * (y[i] - mean);
  }
  return xx > 0 && yy > 0 ? xy / std::sqrt(xx * yy) : 0;
}

double quantile(std::vector<double> values, double share) {
  const auto at = values.begin() +
                  static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1) + 0.5);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

struct SceneSize {
  int width, height;
};

/// Renders of one scene, at one size.
void add_renders(const Bench& bench, Scene scene, const std::string& name, bool sets_model,
                 std::vector<PredictedRender>& out) {
  const std::string setting = scene.settings[0].name;
  bench.step(fmt::format("{} {}, {} px wide", name, setting, scene.width));
  const Subject s = make_antialiased(bench.backend, std::move(scene), setting);
  const int rays = bench.is_quick ? 4 : 64;
  const TwoTruths truths = make_two_truths(s, rays);
  for (PredictedRender& render : predicted_renders(bench.backend, s, truths)) {
    render.scene = name + " " + setting;
    render.sets_model = sets_model;
    out.push_back(std::move(render));
  }
}

void add_builtin_scenes(const Bench& bench, const SceneSize& size,
                        std::vector<PredictedRender>& out) {
  for (const std::string& name : scene_names()) {
    const Scene scene = make_scene(name, size.width, size.height);
    for (const FocusSetting& setting : scene.settings) {
      Scene one = make_scene(name, size.width, size.height);
      one.settings = {setting};
      add_renders(bench, std::move(one), name, true, out);
      if (bench.is_quick) return;
    }
  }
}

void add_random_scenes(const Bench& bench, const SceneSize& size, std::uint32_t first,
                       std::uint32_t count, bool sets_model, std::vector<PredictedRender>& out) {
  for (std::uint32_t seed = first; seed < first + (bench.is_quick ? 1 : count); ++seed) {
    add_renders(bench, random_scene(bench.size(size.width), bench.size(size.height), seed),
                "random-" + std::to_string(seed), sets_model, out);
  }
}

}  // namespace

double PredictedRender::true_db() const { return psnr_of(true_square); }

std::vector<PredictedRender> predicted_renders(Backend& backend, const Subject& subject,
                                               const TwoTruths& truths) {
  std::vector<PredictedRender> out;
  const Frame frame = subject.frame();
  for (const Quality quality : all_qualities) {
    const MethodSettings settings = default_chain(quality);
    const MethodResult result = apply_method(frame, settings, backend);
    const Prediction prediction(frame, *settings.chain, result, true);
    const Plane squares = square_errors(result.colour, truths);
    PredictedRender render;
    render.width = frame.width;
    render.quality = quality;
    render.true_square = mean_of(squares);
    render.expected = prediction.of_frame();
    render.signs = prediction.mean_signs();
    render.rank_correlation = rank_correlation(prediction.planes()[0], squares);
    out.push_back(std::move(render));
  }
  return out;
}

std::vector<PredictedRender> all_predicted_renders(const Bench& bench) {
  std::vector<PredictedRender> out;
  for (const SceneSize& size : {SceneSize{160, 104}, {320, 208}, {640, 400}}) {
    add_builtin_scenes(bench, size, out);
    if (bench.is_quick) break;
  }
  add_random_scenes(bench, {160, 104}, 100, 16, true, out);
  add_random_scenes(bench, {320, 208}, 0, 60, true, out);
  add_random_scenes(bench, {640, 400}, 60, 24, true, out);
  add_random_scenes(bench, {640, 400}, 200, 40, true, out);
  add_random_scenes(bench, {480, 300}, 240, 30, false, out);
  return out;
}

std::vector<std::string> prediction_columns() {
  return {"renders",
          "median, dB",
          "median distance",
          "nine in ten within",
          "inside the interval",
          "rank correlation of pixels"};
}

std::vector<std::string> prediction_row(const std::vector<const PredictedRender*>& renders) {
  std::vector<double> off, distance, correlation;
  double inside = 0;
  for (const PredictedRender* render : renders) {
    off.push_back(render->off_db());
    distance.push_back(std::fabs(render->off_db()));
    correlation.push_back(render->rank_correlation);
    inside += render->is_within();
  }
  return {std::to_string(renders.size()),
          fixed(quantile(off, 0.5)),
          fixed(quantile(distance, 0.5)),
          fixed(quantile(distance, 0.9)),
          fixed(100 * inside / static_cast<double>(renders.size()), 0) + " %",
          fixed(quantile(correlation, 0.5))};
}

}  // namespace defray::perf
