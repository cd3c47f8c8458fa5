// Shinya 1994, plate 1: linear filtering makes an opaque bar in focus transparent; the accumulation
// buffer and the ray distribution buffer do not.
#include <cmath>

#include "experiments.h"
#include "measure/metrics.h"

namespace defray::perf {
namespace {

/// Inside of the bars, where nothing but the bars shows in the truth: pixels of the bars' depth
/// with such neighbours all around, and the ball's light not over them.
std::vector<std::uint8_t> bar_mask(const Subject& s, const std::vector<Plane>& truth) {
  const int width = s.scene.width, height = s.scene.height;
  const auto is_bar = [&](int x, int y) {
    return std::fabs(s.pinhole.depth[static_cast<std::size_t>(y * width + x)] - 3) < 1e-4;
  };
  std::vector<std::uint8_t> mask(s.pinhole.depth.size());
  for (int y = 1; y + 1 < height; ++y) {
    for (int x = 1; x + 1 < width; ++x) {
      bool inside = true;
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) inside = inside && is_bar(x + dx, y + dy);
      }
      const auto at = static_cast<std::size_t>(y * width + x);
      mask[at] = inside && std::fabs(truth[1][at] - s.pinhole.colour[1][at]) < 0.002f;
    }
  }
  return mask;
}

double mean_where(const std::vector<Plane>& planes, const std::vector<std::uint8_t>& mask) {
  double sum = 0, count = 0;
  for (const Plane& plane : planes) {
    for (std::size_t i = 0; i < plane.size(); ++i) {
      if (!mask[i]) continue;
      sum += static_cast<double>(plane[i]);
      ++count;
    }
  }
  return sum / count;
}

std::vector<std::uint8_t> background_mask(const Subject& s) {
  std::vector<std::uint8_t> mask;
  for (const float z : s.pinhole.depth) mask.push_back(z > 5);
  return mask;
}

}  // namespace

Section plate1(const Bench& bench) {
  bench.step("scene");
  const Subject s = make_subject(bench.backend,
                                 make_scene("plate1", bench.size(640), bench.size(480)), "default");
  bench.step("truth");
  const auto truth = render_truth(s.scene, s.lens, bench.is_quick ? 64 : 1024, 1).colour;
  bench.step("accumulation buffer");
  const auto accumulation = render_accumulation(s.scene, s.lens, accumulation_points(9));
  bench.step("filters");
  const auto linear = render(bench.backend, s, linear_of());
  const auto rdb = render(bench.backend, s, rdb_of(9));

  const auto bars = bar_mask(s, truth);
  const double opaque = mean_where(truth, bars);
  const double background = mean_where(s.pinhole.colour, background_mask(s));
  Table table{"plate1",
              "Light inside the opaque bars, and the whole picture against the truth",
              {"method", "mean inside the bars", "leaked, % of the background's light",
               "PSNR sRGB dB", "PSNR linear dB"},
              {}};
  const auto add = [&](const std::string& name, const std::vector<Plane>& picture) {
    const Comparison c = compare(picture, truth, s.scene.width);
    const double leaked = 100 * (mean_where(picture, bars) - opaque) / background;
    table.rows.push_back({name, fixed(mean_where(picture, bars), 4), fixed(leaked, 2),
                          fixed(c.psnr_srgb_db), fixed(c.psnr_linear_db)});
    return leaked;
  };
  add("pinhole", s.pinhole.colour);
  const double linear_leak = add("linear", linear);
  add("accumulation, 81 views", accumulation);
  const double rdb_leak = add("RDB 9x9", rdb);
  add("truth", truth);
  return {
      "Plate 1: partial occlusion",
      "Shinya 1994: with linear filtering the black rectangle, which is in focus, looks partially "
      "transparent; the accumulation buffer and the RDB method suppress the artefact completely.",
      {fmt::format("Linear filtering lets {:.1f} % of the background's light shine through the "
                   "opaque bars, the RDB {:.2f} %.",
                   linear_leak, rdb_leak)},
      {table},
      {sheet(bench, "plate1", "Plate 1. The bars are opaque and in focus.",
             {{"pinhole", &s.pinhole.colour},
              {"linear", &linear},
              {"accumulation, 81 views", &accumulation},
              {"RDB 9x9", &rdb}},
             s.scene.width, s.scene.height)}};
}

}  // namespace defray::perf
