#pragma once
// The table of kernels: how each is run, its scalar twin, and how far they may lie apart. A new
// kernel needs one entry here, and its twin.
#include <string>
#include <vector>

#include "frame/backend.h"
#include "validation/case.h"
#include "validation/input.h"

namespace defray::validation {

/// What a kernel or its twin gives: whole numbers, planes of floats, or both.
struct Outcome {
  std::vector<std::int64_t> integers = {};
  std::vector<Plane> planes = {};
};

/// Exact arithmetic, to measure float's rounding against.
struct Exact {
  std::vector<std::vector<double>> planes;
  /// |float - exact| <= roundings x (L x 2^-24 + 2^-149), L the largest magnitude of the plane's
  /// input. For whole numbers: the bound is 1/2 + roundings x |exact| x 2^-24.
  double roundings;
};

struct KernelCheck {
  const char* name;  ///< The kernel's, or with a way of running it behind.
  const char* rule;  ///< For people: how far kernel and twin may lie apart, and why.
  /// On a device, or by the twins.
  Outcome (*run)(Backend&, const Case&, const Input&);

  /// Operations of the twin (work.h); infinite where it does not take such a case.
  double (*work)(const Case&);

  /// Roundings u = 2^-24 of the largest input L by which floats may differ on a device that does
  /// not promise correctly rounded divisions and roots (they may be 2.5 and 3 ulp off there).
  double (*loose_roundings)(const Case&) = nullptr;

  /// Where results have a derived bound. Whole numbers without floats are held to it alone, floats
  /// to their twin's bits too.
  Exact (*exact)(const Case&, const Input&) = nullptr;

  /// What a session may take where the case wants bands; null: band_memory of one layer.
  std::size_t (*memory)(const Case&, const Input&) = nullptr;

  bool needs_two_passes = false;  ///< Runs without 64-bit atomics.
};

/// Those of the stages before the RDB: a part of the table.
std::vector<KernelCheck> stage_checks();
std::vector<KernelCheck> rdb_checks();
std::vector<KernelCheck> highlight_checks();
std::vector<KernelCheck> splat_checks();

/// What bands of the case's rows take, with the rows that a kernel looks at beyond them by the
/// launch table.
std::size_t band_memory(const char* kernel, const Case& c, int layers);

template <typename Range>
Outcome integers(const Range& values) {
  return {{values.begin(), values.end()}, {}};
}

/// One quotient <= 2 L, 2.5 ulp = 5 u off in the kernel, and the sum after it rounded anew.
inline double one_division(const Case&) { return 12; }

inline constexpr const char* integer_rule = "equal: integer arithmetic";
inline constexpr const char* bits_rule = "equal bits: + - x / sqrt in one order";

/// At least one entry a kernel.
const std::vector<KernelCheck>& kernel_checks();

}  // namespace defray::validation
