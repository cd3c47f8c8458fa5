#include "rdb/fragments.h"

#include <bit>

namespace defray {

float no_fragment() { return std::bit_cast<float>(DEFRAY_EMPTY); }

bool is_fragment(float depth) { return std::bit_cast<std::uint32_t>(depth) != DEFRAY_EMPTY; }

}  // namespace defray
