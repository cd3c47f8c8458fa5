#include "chain/quality.h"

namespace defray {

const char* to_string(Quality quality) {
  constexpr std::array words{"preview", "draft", "normal", "high"};
  return words[static_cast<std::size_t>(quality)];
}

ChainSettings settings_for(Quality quality) {
  ChainSettings s;
  if (quality == Quality::preview) {
    s.cells_per_side = 6;
    s.hidden = Hidden::fill;
    s.half_size = true;
  }
  if (quality == Quality::draft) {
    s.cells_per_side = 9;
    s.hidden = Hidden::fill;
  }
  if (quality == Quality::high) {
    s.cells_per_side = 33;
    s.pattern_shifts = 48;
  }
  return s;
}

ChainSettings with_quality(ChainSettings chain, Quality quality) {
  const ChainSettings said = settings_for(quality);
  chain.cells_per_side = said.cells_per_side;
  chain.hidden = said.hidden;
  chain.pattern_shifts = said.pattern_shifts;
  chain.half_size = said.half_size;
  return chain;
}

}  // namespace defray
