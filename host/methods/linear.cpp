#include "methods/linear.h"

#include <cstdlib>

#include "base/error.h"
#include "lens/coc.h"

namespace defray {
namespace {

/// Whole pixels that a disc of this radius reaches; it ends half a pixel beyond its radius.
int reach_of(std::int32_t coc_quanta) {
  constexpr std::int32_t half = 1 << (DEFRAY_COC_FRACTION_BITS - 1);
  return (std::abs(coc_quanta) + half) >> DEFRAY_COC_FRACTION_BITS;
}

}  // namespace

float radius_px(std::int32_t coc_quanta) {
  return static_cast<float>(std::abs(coc_quanta)) * px_per_quantum;
}

int linear_reach(std::span<const std::int32_t> coc_quanta) {
  const std::int32_t largest = largest_coc(coc_quanta);
  if (largest > linear_max_radius_px << DEFRAY_COC_FRACTION_BITS) {
    fail(ErrorKind::usage,
         "CoC radii go up to {:.6g} px: linear filtering takes {} px at most; limit them with "
         "{}, or use {} rdb",
         static_cast<double>(radius_px(largest)), linear_max_radius_px, field("max_coc_px"),
         field("method"));
  }
  return reach_of(largest);
}

}  // namespace defray
