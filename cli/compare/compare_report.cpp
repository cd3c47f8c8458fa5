#include "compare/compare_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace defray::cli {
namespace {

using Json = nlohmann::ordered_json;
using OfFrame = std::optional<Excess> Found::*;

Json errors_json(const Errors& e) {
  return {{"pixels", e.pixels},
          {"psnr_srgb_db", e.psnr_srgb_db},
          {"psnr_linear_db", e.psnr_linear_db},
          {"rms", e.rms}};
}

Json excess_json(const Excess& e) {
  return {{"rms", e.rms},
          {"p999", e.p999},
          {"worst", e.worst},
          {"worst_x", e.worst_x},
          {"worst_y", e.worst_y}};
}

void print_errors(const char* where, const Errors& e) {
  if (e.pixels == 0) {
    fmt::print("{} 0 px\n", where);
    return;
  }
  fmt::print("{} {} px: PSNR {:.2f} dB (sRGB-encoded), {:.2f} dB (linear), RMS error {:.6g}\n",
             where, e.pixels, e.psnr_srgb_db, e.psnr_linear_db, e.rms);
}

void print_excess(const char* what, const std::optional<Excess>& e) {
  if (!e) return;
  fmt::print("{}: RMS {:.3f}, 99.9th percentile {:.2f}, worst {:.1f} at pixel ({}, {})\n", what,
             e->rms, e->p999, e->worst, e->worst_x, e->worst_y);
}

/// Over all pixels of all frames, as many in each.
void print_excesses(const char* what, const std::vector<Found>& frames,
                    const std::vector<int>& numbers, OfFrame of) {
  double squares = 0;
  std::size_t count = 0, worst = 0;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const std::optional<Excess>& e = frames[i].*of;
    if (!e) continue;
    squares += e->rms * e->rms;
    if (count++ == 0 || !(e->p999 <= (frames[worst].*of)->p999)) worst = i;
  }
  if (count == 0) return;
  fmt::print("  {}: RMS {:.3f}, 99.9th percentile at most {:.2f} (frame {})\n", what,
             std::sqrt(squares / static_cast<double>(count)), (frames[worst].*of)->p999,
             numbers[worst]);
}

}  // namespace

void print_json(const Found& found, std::optional<int> frame) {
  const Comparison& c = found.comparison;
  Json line;
  if (frame) line["frame"] = *frame;
  line.update({{"equal", c.worst == 0 && found.alpha_difference.value_or(0) == 0},
               {"psnr_srgb_db", c.psnr_srgb_db},
               {"psnr_linear_db", c.psnr_linear_db},
               {"rms", c.rms},
               {"worst", c.worst},
               {"worst_x", c.worst_x},
               {"worst_y", c.worst_y},
               {"worst_a", c.worst_a},
               {"worst_b", c.worst_b},
               {"ssim", c.ssim},
               {"energy_ratio", c.energy_ratio}});
  if (found.alpha_difference) line["alpha_difference"] = *found.alpha_difference;
  if (found.band) {
    line["edge_band"] = errors_json(found.band->inside);
    line["outside_edge_band"] = errors_json(found.band->outside);
  }
  if (found.false_edges) line["false_edges"] = excess_json(*found.false_edges);
  if (found.false_changes) line["false_changes"] = excess_json(*found.false_changes);
  fmt::print("{}\n", line.dump());
}

void print_text(const Found& found, std::optional<int> frame) {
  const Comparison& c = found.comparison;
  if (frame) fmt::print("frame {}\n", *frame);
  fmt::print("PSNR {:.2f} dB (sRGB-encoded), {:.2f} dB (linear), both clipped to 0...1\n",
             c.psnr_srgb_db, c.psnr_linear_db);
  fmt::print("RMS error {:.6g}, worst {:.6g} at pixel ({}, {}) (linear, not clipped)\n", c.rms,
             c.worst, c.worst_x, c.worst_y);
  fmt::print("  there {:.6g} against {:.6g} (R G B)\n", fmt::join(c.worst_a, " "),
             fmt::join(c.worst_b, " "));
  fmt::print("SSIM {:.4f} (sRGB-encoded, mean of R G B), energy ratio {:.6g}\n", c.ssim,
             c.energy_ratio);
  if (found.alpha_difference.value_or(0) > 0) {
    fmt::print("alpha differs by up to {:.6g}: none of these figures counts it\n",
               *found.alpha_difference);
  }
  if (found.band) {
    print_errors("edge band", found.band->inside);
    print_errors("outside it", found.band->outside);
  }
  print_excess("edges that B has not (255ths)", found.false_edges);
  print_excess("changes that B has not (255ths)", found.false_changes);
}

void print_summary(const std::vector<Found>& frames, const std::vector<int>& numbers) {
  double squares = 0;
  std::size_t worst = 0;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const double psnr = frames[i].comparison.psnr_srgb_db;
    squares += std::pow(10, -psnr / 10);
    if (!(psnr >= frames[worst].comparison.psnr_srgb_db)) worst = i;
  }
  fmt::print("{} frames: PSNR {:.2f} dB (sRGB-encoded), least {:.2f} dB (frame {})\n",
             frames.size(), -10 * std::log10(squares / static_cast<double>(frames.size())),
             frames[worst].comparison.psnr_srgb_db, numbers[worst]);
  print_excesses("edges that B has not", frames, numbers, &Found::false_edges);
  print_excesses("changes that B has not", frames, numbers, &Found::false_changes);
}

}  // namespace defray::cli
