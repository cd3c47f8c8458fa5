#include "library/frame_notes.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "base/error.h"
#include "lens/coc.h"
#include "prediction/error_model.h"

namespace defray {
namespace {

constexpr double smallest_seen_px = 0.5;
/// What lies at a depth may be stored as one that is off by this share: 8 bits of it are.
constexpr double stored_error = 0.01;
/// CoC radii above this share of the frame's width, in more than this share of its pixels.
constexpr double huge_radius = 0.04, huge_share = 0.95;

}  // namespace

void note_depth(const DepthPlane& depth, const DepthSettings& settings, const DepthReport& report,
                std::vector<std::string>& notes) {
  const bool is_range =
      settings.kind == DepthKind::normalized || settings.kind == DepthKind::zbuffer;
  if (report.nearest_units == 0 && report.behind_camera == 0) {
    notes.push_back(fmt::format(
        "all of {} is background{}, nothing has a depth: is it the right channel?", depth.channel,
        report.not_a_number > 0 ? fmt::format(" ({} px NaN)", report.not_a_number) : ""));
  }
  if (depth.integer_bits == 8 && !depth.is_smoothed) {
    notes.push_back(
        "the depth has 8 bits, 256 steps: surfaces become terraces; render it as 32-bit float");
  }
  if (depth.integer_bits > 0 && settings.kind == DepthKind::z) {  // others were asked for
    notes.push_back(fmt::format(
        "the depth is stored as whole numbers of {} bits, 0 to 1, and taken as {:g} to "
        "{:g} units: a range from near to far is {} normalized",
        depth.integer_bits, report.nearest_units, report.farthest_units, field("depth.kind")));
  }
  if (depth.is_mist && !is_range) {
    notes.push_back(fmt::format(
        "{} is a mist pass, clamped and no distance: render the depth itself, or say what its "
        "range is with {} normalized",
        depth.channel, field("depth.kind")));
  }
  if (report.behind_camera > 0) {
    const bool is_negative = settings.kind != DepthKind::negative_z;
    notes.push_back(fmt::format("depth is {} in {} px ({:.1f} %), taken as background{}",
                                is_negative ? "negative" : "positive", report.behind_camera,
                                100.0 * static_cast<double>(report.behind_camera) /
                                    static_cast<double>(depth.values.size()),
                                settings.kind == DepthKind::z
                                    ? "; camera-space -z is " + field("depth.kind") + " negative-z"
                                    : ""));
  }
}

void note_focus(const Lens& lens, const DepthReport& report, std::vector<std::string>& notes) {
  const double begin = lens.focus_distance_units;
  const double end = std::max(begin, lens.focus_end_units);
  if (report.nearest_units == 0) return;  // nothing but background
  const bool is_before = end < report.nearest_units;
  // At infinity there is the background to be sharp.
  const bool is_behind =
      begin > report.farthest_units && (report.background == 0 || !std::isinf(begin));
  if (!is_before && !is_behind) return;
  const double focus = is_before ? end : begin;
  const double nearest = is_before ? report.nearest_units : report.farthest_units;
  if (std::fabs(focus - nearest) <= stored_error * nearest) return;
  notes.push_back(fmt::format("focus {:.6g} lies outside all depths, {:.6g} to {:.6g} units: {}",
                              focus, report.nearest_units, report.farthest_units,
                              "nothing there is sharp; is the unit right?"));
}

void note_small_coc(const Lens& lens, double largest_px, std::vector<std::string>& notes) {
  if (lens.aperture_diameter_mm == 0 || largest_px >= smallest_seen_px) return;
  notes.push_back(
      fmt::format("all CoC radii are below half a pixel, the largest is {:.3g} px: nothing is "
                  "blurred visibly",
                  largest_px));
}

void note_coc(const Lens& lens, std::span<const std::int32_t> coc_quanta, int display_width,
              std::vector<std::string>& notes) {
  if (lens.aperture_diameter_mm == 0 || coc_quanta.empty()) return;
  note_small_coc(lens, largest_coc(coc_quanta) * static_cast<double>(px_per_quantum), notes);
  const double limit = huge_radius * display_width;
  const auto huge = std::count_if(coc_quanta.begin(), coc_quanta.end(), [&](std::int32_t q) {
    return std::abs(static_cast<double>(q)) * static_cast<double>(px_per_quantum) > limit;
  });
  const double share = static_cast<double>(huge) / static_cast<double>(coc_quanta.size());
  if (share > huge_share) {
    notes.push_back(fmt::format(
        "CoC radii are above {:.3g} px, 4 % of the width, in {:.1f} % of the picture: are focus, "
        "unit and f-number right?",
        limit, 100 * share));
  }
}

void note_target(const std::optional<ExpectedError>& expected, const ErrorSettings& wanted,
                 std::vector<std::string>& notes) {
  if (!expected || !expected->misses_target) return;
  const auto most = std::max_element(expected->shares.begin(), expected->shares.end());
  const auto cause = static_cast<Cause>(most - expected->shares.begin());
  notes.push_back(fmt::format(
      "no quality is expected to reach {:.4g} dB, {:.1f} dB is the most: {:.0f} % of the "
      "error is {}",
      *wanted.target_db, expected->psnr_db, 100 * *most, about(cause)));
}

void note_budget(const BudgetChoice& c, std::vector<std::string>& notes) {
  if (c.expected_ms <= c.budget_ms) return;
  notes.push_back(
      fmt::format("{} of {:.4g}: the fastest quality, preview, takes about {:.3g} ms here",
                  field("budget_ms"), c.budget_ms, c.expected_ms));
}

}  // namespace defray
