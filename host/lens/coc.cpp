#include "lens/coc.h"

#include <cstdlib>

namespace defray {

std::int32_t largest_coc(std::span<const std::int32_t> coc_quanta) {
  std::int32_t largest = 0;
  for (const std::int32_t q : coc_quanta) largest = std::max(largest, std::abs(q));
  return largest;
}

}  // namespace defray
