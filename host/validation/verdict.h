#pragma once
// Kernel against twin, value by value.
#include <array>
#include <cstdint>
#include <string>

#include "validation/kernel_checks.h"

namespace defray::validation {

/// Distances in units in the last place: 0, 1, 2, 3-4, 5-8, ... doubling, the last open.
inline constexpr std::size_t ulp_bins = 34;

/// Units in the last place between two floats: how many floats lie from one to the other. NaN
/// matches NaN, -0 is not 0 (1 ulp); NaN against a number is the largest distance, 2^32 - 1.
std::uint32_t ulp_distance(float a, float b);

/// Bin of a distance, and its name: "3-4".
std::size_t ulp_bin(std::uint32_t distance);
std::string ulp_bin_name(std::size_t bin);

/// Outcome of one case, or of many.
struct Verdict {
  std::uint64_t compared = 0;
  std::uint64_t differing = 0;  ///< Not the same bits (numbers; NaN matches NaN).
  std::uint64_t wrong = 0;      ///< Farther apart than the rule allows.
  std::array<std::uint64_t, ulp_bins> ulp_histogram{};  ///< Of floats.

  double worst = 0;          ///< Largest difference from the twin: whole numbers, or floats in ulp.
  std::size_t worst_at = 0;  ///< Index among all its values: whole numbers, then plane by plane.
  double exact_share = 0;    ///< Largest error against exact arithmetic, as a share of its bound.

  bool has_floats() const;

  /// Adds another case; true if that holds the worst value so far.
  bool add(const Verdict& other);
};

/// `keeps_denormals` and `rounds_divisions` as DeviceInfo has them: where a device does not promise
/// them, the slack that OpenCL allows it.
Verdict compare(const KernelCheck& check, const Case& c, const Input& in, const Outcome& kernel,
                const Outcome& twin, bool keeps_denormals, bool rounds_divisions);

/// Measures a kernel's values against exact ones, where the input is finite: fills exact_share and
/// counts values beyond the bound as wrong.
void compare_exact(const Exact& exact, const Input& in, const Outcome& kernel, Verdict& verdict);

/// FNV-1a over all values.
std::uint64_t hash_of(const Outcome& values);

}  // namespace defray::validation
