#pragma once
// The frame that the chain works on, all of it at once.
#include "chain/steps/border.h"

namespace defray::test {

/// All rows of the frame, with the margin.
inline Frame extended(const Frame& f, Border border, bool wants_data, ChainReport& report) {
  Frame e = with_margin(f, border, report);
  const Rows all{0, e.height};
  repeat_coc(f, e, all, e.coc_quanta);
  repeat_surfaces(f, border, wants_data, all, e);
  return e;
}

}  // namespace defray::test
