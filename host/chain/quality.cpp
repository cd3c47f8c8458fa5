#include "defray/options.h"

namespace defray {

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

}  // namespace defray
