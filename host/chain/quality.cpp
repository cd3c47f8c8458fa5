#include "chain/quality.h"

#include "base/error.h"

namespace defray {

const char* to_string(Quality quality) {
  constexpr std::array words{"preview", "draft", "normal", "high"};
  const auto index = static_cast<std::size_t>(quality);
  if (index >= words.size()) fail(ErrorKind::usage, "there is no quality {}", index);
  return words[index];
}

ChainSettings settings_for(Quality quality) {
  to_string(quality);  // refuses what is none
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

const std::vector<Rung>& rungs() {
  static const std::vector<Rung> all = [] {
    std::vector<Rung> made;
    const auto add = [&](Quality quality, int first, int last) {
      for (int n = first; n <= last; ++n) made.push_back({quality, n});
    };
    // Draft's lens points up to where patterns cost no more; those gain more than lens points.
    const auto own = [](Quality quality) { return settings_for(quality).cells_per_side; };
    add(Quality::preview, own(Quality::preview), own(Quality::preview));
    add(Quality::draft, own(Quality::draft) - 2, 2 * own(Quality::draft));
    add(Quality::normal, own(Quality::draft), own(Quality::high) - 1);
    add(Quality::high, own(Quality::high), own(Quality::high));
    return made;
  }();
  return all;
}

ChainSettings with_rung(ChainSettings chain, const Rung& rung) {
  const ChainSettings said = settings_for(rung.quality);
  chain.cells_per_side = rung.cells_per_side;
  chain.hidden = said.hidden;
  chain.pattern_shifts = said.pattern_shifts;
  chain.half_size = said.half_size;
  return chain;
}

}  // namespace defray
