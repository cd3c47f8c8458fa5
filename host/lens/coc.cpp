#include "lens/coc.h"

#include <cstdlib>

namespace defray {

Plane radii_px(std::span<const std::int32_t> coc_quanta) {
  Plane radii;
  radii.reserve(coc_quanta.size());
  for (const std::int32_t q : coc_quanta) radii.push_back(static_cast<float>(q) * px_per_quantum);
  return radii;
}

std::int32_t largest_coc(std::span<const std::int32_t> coc_quanta) {
  std::int32_t largest = 0;
  for (const std::int32_t q : coc_quanta) largest = std::max(largest, std::abs(q));
  return largest;
}

}  // namespace defray
