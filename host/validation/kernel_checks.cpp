#include "validation/kernel_checks.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "lens/coc.h"
#include "methods/gather.h"
#include "methods/linear.h"
#include "opencl/bands.h"
#include "reference/reference.h"
#include "validation/checks_patterns.h"
#include "validation/either.h"
#include "validation/stage_input.h"
#include "validation/work.h"

namespace defray::validation {
namespace {

double square(double x) { return x * x; }

// coc ---------------------------------------------------------------------------------------------

Outcome run_coc(Backend& backend, const Case& c, const Input& in) {
  return integers(backend.coc(in.lens, c.width, in.depth));
}

/// The radius before it is rounded to quanta: 4 ulp = 8 u
/// (tests/kernels/lens/coc_accuracy_test.cpp).
Exact exact_coc(const Case& c, const Input& in) {
  constexpr double limit = DEFRAY_COC_LIMIT_QUANTA;
  std::vector<double> exact;
  for (const float z : in.depth) {
    const double quanta = quanta_per_px * reference::coc_px(in.lens, c.width, double{z});
    exact.push_back(std::clamp(quanta, -limit, limit));
  }
  return {{exact}, 8};
}

// linear ------------------------------------------------------------------------------------------

int reach_px(const Case& c) { return static_cast<int>(c.coc_px + 0.5); }
double side_px(const Case& c) { return 2.0 * reach_px(c) + 1; }

/// Larger ones it does not take.
double linear_cost(const Case& c) {
  return c.coc_px > linear_max_radius_px ? HUGE_VAL : linear_work(c);
}

std::size_t linear_memory(const Case& c, const Input& in) {
  return band_bytes("linear_psf", frame_of(c, in), linear_reach(in.coc_quanta), c.band_rows);
}

Outcome run_linear(Backend& backend, const Case& c, const Input& in) {
  return {{}, taken(backend.linear(frame_of(c, in)))};
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

Outcome run_tiltshift(Backend& backend, const Case& c, const Input&) {
  return integers(backend.tiltshift(tiltshift_case(c)));
}

// gather ------------------------------------------------------------------------------------------

template <GatherKind kind>
Outcome run_gather(Backend& backend, const Case& c, const Input& in) {
  return {{}, taken(backend.gather(frame_of(c, in), gather_case(kind, c)))};
}

template <GatherKind kind>
std::size_t gather_memory(const Case& c, const Input& in) {
  const Frame f = frame_of(c, in);
  const char* const kernel = kind == GatherKind::aware ? "gather_aware" : "gather_literal";
  return band_bytes(kernel, f, gather_reach_px(f), c.band_rows);
}

/// n samples of differences <= 2 L, their weights from a root 6 u off of distances up to the search
/// radius and a quotient 5 u off, times the area that a near sample stands for.
double aware_roundings(const Case& c) {
  const double search = std::min(c.coc_px, 65536.0);
  return 4 * c.samples * (6 * search + 12) * std::max(1.0, 4 * square(search) / c.samples);
}

/// Of rows of tiles.
std::size_t tiles_memory(const Case& c, const Input& in) {
  return band_bytes("gather_tiles", gather_tiles_of(frame_of(c, in)), 0, c.band_rows);
}

std::size_t reach_memory(const Case& c, const Input& in) {
  const Frame f = frame_of(c, in);
  const auto p = tile_params(f.width, f.height, f.coc_range().largest_radius());
  return band_bytes("gather_reach", gather_tiles_of(f), p.reach_tiles, c.band_rows);
}

Outcome run_tiles(Backend& backend, const Case& c, const Input& in) {
  const Frame f = frame_of(c, in);
  return integers(either(
      backend, [&](DeviceBackend& d) { return d.gather_tiles(f); },
      [&] { return reference::gather_tiles(f); }));
}

Outcome run_reach(Backend& backend, const Case& c, const Input& in) {
  const Frame f = frame_of(c, in);
  return integers(either(
      backend, [&](DeviceBackend& d) { return d.gather_reach(f); },
      [&] { return reference::gather_reach(f); }));
}

/// The whole table, by name.
std::vector<KernelCheck> with_stages(std::vector<KernelCheck> checks) {
  for (const std::vector<KernelCheck>& more :
       {stage_checks(), rdb_checks(), highlight_checks(), patterns_checks(), splat_checks()}) {
    checks.insert(checks.end(), more.begin(), more.end());
  }
  std::sort(checks.begin(), checks.end(), [](const KernelCheck& a, const KernelCheck& b) {
    return std::string_view(a.name) < b.name;
  });
  return checks;
}

}  // namespace

std::size_t band_memory(const char* kernel, const Case& c, int layers) {
  return band_bytes(kernel, {.width = c.width, .height = c.height, .layers = layers}, 0,
                    c.band_rows);
}

const std::vector<KernelCheck>& kernel_checks() {
  constexpr GatherKind literal = GatherKind::literal, aware = GatherKind::aware;
  static const std::vector<KernelCheck> checks = with_stages({
      {"coc", "within 1/2 quantum + 4 ulp of the exact radius", run_coc, pixels, nullptr,
       exact_coc},
      {"gather_aware", bits_rule, run_gather<aware>, gather_work, aware_roundings, nullptr,
       gather_memory<aware>},
      {"gather_literal", bits_rule, run_gather<literal>, gather_work, one_division, nullptr,
       gather_memory<literal>},
      {"gather_reach", integer_rule, run_reach, tiles_work, nullptr, nullptr, reach_memory},
      {"gather_tiles", integer_rule, run_tiles, tiles_work, nullptr, nullptr, tiles_memory},
      {"linear_psf", bits_rule, run_linear, linear_cost, linear_roundings, exact_linear,
       linear_memory},
      {"tiltshift", bits_rule, run_tiltshift, pixels},
  });
  return checks;
}

}  // namespace defray::validation
