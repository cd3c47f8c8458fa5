#pragma once
// The table of kernels: how each is run, its scalar twin, and how far they may lie apart. A new
// kernel needs one entry here, and its twin.
#include <optional>
#include <string>
#include <vector>

#include "opencl/session.h"
#include "validation/case.h"
#include "validation/input.h"

namespace defray::validation {

/// What a kernel or its twin gives: whole numbers, or planes of floats.
struct Values {
  std::vector<std::int64_t> integers = {};
  std::vector<Plane> planes = {};
};

/// The same planes without float's rounding, and how far from them a float sum may lie:
/// |float - exact| <= terms x (L x 2^-24 + 2^-149), L the largest magnitude of the plane's input.
struct Exact {
  std::vector<std::vector<double>> planes;
  double terms;
};

struct KernelCheck {
  const char* kernel;
  const char* rule;  ///< For people: how far kernel and twin may lie apart, and why.
  Values (*run)(Session&, const Case&, const Input&);
  Values (*twin)(const Case&, const Input&);

  /// Operations of the twin: a grid leaves out what takes too long.
  double (*work)(const Case&);

  /// Largest difference of whole numbers, given the twin's; none: they must be equal.
  double (*integer_slack)(std::int64_t twin) = nullptr;

  /// Roundings u = 2^-24 of the largest input L by which floats may differ on a device that does
  /// not promise correctly rounded divisions and roots (they may be 2.5 and 3 ulp off there).
  double (*loose_roundings)(const Case&) = nullptr;

  /// Exact arithmetic to measure float's rounding against, where a sum has a bound.
  std::optional<Exact> (*exact)(const Case&, const Input&) = nullptr;
};

/// One entry a kernel.
const std::vector<KernelCheck>& kernel_checks();

}  // namespace defray::validation
