#include "validation/kernel_checks.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "device/device_stages.h"
#include "methods/gather.h"
#include "methods/linear.h"
#include "opencl/launch_table.h"
#include "rdb/rdb.h"
#include "rdb/rdb_plan.h"
#include "reference/reference.h"
#include "validation/checks_patterns.h"
#include "validation/rdb_winners.h"
#include "validation/stage_input.h"
#include "validation/work.h"

namespace defray::validation {
namespace {

template <typename Range>
Outcome integers(const Range& values) {
  return {{values.begin(), values.end()}, {}};
}

double square(double x) { return x * x; }

// coc ---------------------------------------------------------------------------------------------

Outcome run_coc(Stages& stages, const Case& c, const Input& in) {
  return integers(stages.coc(in.lens, c.width, in.depth));
}

/// The radius before it is rounded to quanta: 4 ulp = 8 u (tests/coc_accuracy_test.cpp).
Exact exact_coc(const Case& c, const Input& in) {
  constexpr double quanta_per_px = 1 << DEFRAY_COC_FRACTION_BITS;
  constexpr double limit = DEFRAY_COC_LIMIT_QUANTA;
  std::vector<double> exact;
  for (const float z : in.depth) {
    const double quanta = quanta_per_px * reference::coc_px(in.lens, c.width, double{z});
    exact.push_back(std::clamp(quanta, -limit, limit));
  }
  return {{exact}, 8};
}

// RDB ---------------------------------------------------------------------------------------------

/// Kernels that no stage shows by itself: the device's own, or else the twin's.
template <typename OnDevice, typename ByTwin>
auto either(Stages& stages, const OnDevice& on_device, const ByTwin& by_twin) {
  auto* const device = dynamic_cast<DeviceStages*>(&stages);
  return device ? on_device(*device) : by_twin();
}

Outcome run_rdb_clear(Stages& stages, const Case& c, const Input&) {
  return integers(either(
      stages,
      [&](DeviceStages& d) { return cleared_on_device(d.session(), c.width, c.height, c.cells); },
      [&] { return cleared_twin(c.width, c.height, c.cells); }));
}

Outcome run_rdb_scatter(Stages& stages, const Case& c, const Input& in) {
  const RayPlan plan = ray_plan(c);
  return {either(
              stages,
              [&](DeviceStages& d) { return winners_on_device(d.session(), in.fragments, plan); },
              [&] { return winners_of_twin(in.fragments, plan); }),
          {}};
}

/// A pass of so many rows with one cell.
std::size_t rdb_memory(const Case& c, const Input&) {
  return size(c.band_rows) * size(c.width) * (rdb_bytes_a_cell + rdb_bytes_a_sum);
}

Outcome run_rdb_merge(Stages& stages, const Case& c, const Input& in) {
  return {{}, stages.rays(in.fragments, ray_plan(c)).means};
}

Outcome run_rdb_seen(Stages& stages, const Case& c, const Input& in) {
  return integers(stages.rays(in.fragments, ray_plan(c)).seen);
}

/// The case's fragments; those that were made up have no data, and others that of any pixel.
Outcome run_rdb_nearest(Stages& stages, const Case& c, const Input& in) {
  Frame f = in.fragments;
  std::vector<std::uint32_t> data;
  for (std::size_t i = 0; i < f.coverage.size(); ++i) {
    const bool is_made_up = (f.coverage[i] & DEFRAY_SYNTHESISED) != 0;
    data.push_back(is_made_up ? DEFRAY_EMPTY : static_cast<std::uint32_t>(i));
  }
  f.data_of = std::move(data);
  RayPlan plan = ray_plan(c);
  plan.wants_nearest = true;
  return integers(stages.rays(f, plan).nearest);
}

/// n additions to sums <= n L, each rounded, then a division, 5 u off at worst, u = 2^-24:
/// (n n L u) / n + 5 L u.
Exact exact_rdb(const Case& c, const Input& in) {
  const double cells = static_cast<double>(make_lens_cells(c.cells, c.jitter).centres.size());
  return {reference::exact_rays(in.fragments, ray_plan(c)), cells + 5};
}

/// One quotient <= 2 L, 2.5 ulp = 5 u off in the kernel, and the sum after it rounded anew.
double one_division(const Case&) { return 12; }

// linear ------------------------------------------------------------------------------------------

int reach_px(const Case& c) { return static_cast<int>(c.coc_px + 0.5); }
double side_px(const Case& c) { return 2.0 * reach_px(c) + 1; }

/// Larger ones it does not take.
double linear_cost(const Case& c) {
  return c.coc_px > linear_max_radius_px ? HUGE_VAL : linear_work(c);
}

std::size_t linear_memory(const Case& c, const Input& in) {
  return linear_band_bytes(c.width, linear_reach(in.coc_quanta), c.band_rows);
}

Outcome run_linear(Stages& stages, const Case& c, const Input& in) {
  return {{}, stages.linear(frame_of(c, in))};
}

/// A term carries the roundings of its root, its subtraction (both of numbers up to the reach + 1
/// for a weight from 0 to 1), its quotient and its product; n terms are then added, each addition
/// rounded. Terms are below L (the disc's sum is at least 1), partial sums below n L.
Exact exact_linear(const Case& c, const Input& in) {
  const double n = square(side_px(c));
  return {reference::linear<double>(frame_of(c, in)), n * (2 * (reach_px(c) + 1) + 3 + n)};
}

/// n weights, each from a root 3 ulp = 6 u off, of numbers up to the reach + 1.
double linear_roundings(const Case& c) { return square(side_px(c)) * 12 * (reach_px(c) + 1); }

// tiltshift ---------------------------------------------------------------------------------------

Outcome run_tiltshift(Stages& stages, const Case& c, const Input&) {
  return integers(stages.tiltshift(tiltshift_case(c)));
}

// gather ------------------------------------------------------------------------------------------

template <GatherKind kind>
Outcome run_gather(Stages& stages, const Case& c, const Input& in) {
  return {{}, stages.gather(frame_of(c, in), gather_case(kind, c))};
}

/// n samples of differences <= 2 L, their weights from a root 6 u off of distances up to the search
/// radius and a quotient 5 u off, times the area that a near sample stands for.
double aware_roundings(const Case& c) {
  const double search = std::min(c.coc_px, 65536.0);
  return 4 * c.samples * (6 * search + 12) * std::max(1.0, 4 * square(search) / c.samples);
}

Outcome run_tiles(Stages& stages, const Case& c, const Input& in) {
  const Frame f = frame_of(c, in);
  return integers(either(
      stages, [&](DeviceStages& d) { return d.gather_tiles(f); },
      [&] { return reference::gather_tiles(f); }));
}

Outcome run_reach(Stages& stages, const Case& c, const Input& in) {
  const Frame f = frame_of(c, in);
  return integers(either(
      stages, [&](DeviceStages& d) { return d.gather_reach(f); },
      [&] { return reference::gather_reach(f); }));
}

/// The whole table, by name.
std::vector<KernelCheck> with_stages(std::vector<KernelCheck> checks) {
  for (const std::vector<KernelCheck>& more :
       {stage_checks(), highlight_checks(), pattern_checks()}) {
    checks.insert(checks.end(), more.begin(), more.end());
  }
  std::sort(checks.begin(), checks.end(), [](const KernelCheck& a, const KernelCheck& b) {
    return std::string_view(a.name) < b.name;
  });
  return checks;
}

constexpr const char* winners_rule = "equal winners: integer arithmetic";
constexpr const char* integer_rule = "equal: integer arithmetic";
constexpr const char* bits_rule = "equal bits: + - x / sqrt in one order";

}  // namespace

std::size_t band_memory(const char* kernel, const Case& c, int layers) {
  const Launch& launch = launch_of(kernel);
  const int rows = c.band_rows + 2 * launch.reach_px + 1;  // 1: see cut_into_bands
  return size(rows) * size(c.width) * size(layers) * launch.bytes_a_surface;
}

const std::vector<KernelCheck>& kernel_checks() {
  constexpr GatherKind literal = GatherKind::literal, aware = GatherKind::aware;
  static const std::vector<KernelCheck> checks = with_stages({
      {"coc", "within 1/2 quantum + 4 ulp of the exact radius", run_coc, pixels, nullptr,
       exact_coc},
      {"gather_aware", bits_rule, run_gather<aware>, gather_work, aware_roundings},
      {"gather_literal", bits_rule, run_gather<literal>, gather_work, one_division},
      {"gather_reach", integer_rule, run_reach, tiles_work},
      {"gather_tiles", integer_rule, run_tiles, tiles_work},
      {"linear_psf", bits_rule, run_linear, linear_cost, linear_roundings, exact_linear,
       linear_memory},
      {"rdb_clear", integer_rule, run_rdb_clear, clear_work},
      {"rdb_merge", bits_rule, run_rdb_merge, rdb_work, one_division, exact_rdb, rdb_memory},
      {"rdb_merge_seen", integer_rule, run_rdb_seen, rdb_work, nullptr, nullptr, rdb_memory},
      {"rdb_nearest", integer_rule, run_rdb_nearest, rdb_work, nullptr, nullptr, rdb_memory},
      {"rdb_scatter", winners_rule, run_rdb_scatter, rdb_work, nullptr, nullptr, rdb_memory},
      {"rdb_scatter_two_pass", winners_rule, run_rdb_scatter, rdb_work, nullptr, nullptr,
       rdb_memory, true},
      {"tiltshift", bits_rule, run_tiltshift, pixels},
  });
  return checks;
}

}  // namespace defray::validation
