// Twin of kernels/chain/patterns_agree.cl, pixel by pixel.
#include <algorithm>
#include <cstdlib>

#include "base/parallel.h"
#include "chain/patterns/patterns.h"
#include "reference/twin_backend.h"

namespace defray::reference {
namespace {

/// Adds a pair of pixels, if they are one.
void add_pair(const Frame& f, const Words& pixels, std::size_t i, std::size_t j,
              std::int32_t tolerance_quanta, DefrayAgreement& sum) {
  const std::uint32_t a = pixels[i], b = pixels[j];
  const std::int64_t apart = std::int64_t{f.coc_quanta[i]} - f.coc_quanta[j];
  if (!(a & b & DEFRAY_PATTERN_KNOWN) || std::abs(apart) > tolerance_quanta) return;
  for (const int bit : {0, 8, 16}) {
    const std::int64_t d = std::int64_t{a >> bit & 255} - (b >> bit & 255);
    sum.squares += static_cast<std::uint64_t>(d * d);
  }
  ++sum.pairs;
}

}  // namespace

std::vector<DefrayAgreement> TwinBackend::patterns_agree(
    const Frame& f, const Words& pixels, const std::vector<DefrayPatternShift>& shifts,
    int row_step, std::int32_t tolerance_quanta) {
  std::vector<DefrayAgreement> all(shifts.size());
  parallel_for(static_cast<int>(shifts.size()), [&](int i) {
    const DefrayPatternShift& s = shifts[size(i)];
    for (int y = std::max(0, -s.y); y < std::min(f.height, f.height - s.y); y += row_step) {
      for (int x = std::max(0, -s.x); x < std::min(f.width, f.width - s.x); ++x) {
        add_pair(f, pixels, f.index(x, y), f.index(x + s.x, y + s.y), tolerance_quanta,
                 all[size(i)]);
      }
    }
  });
  return all;
}

}  // namespace defray::reference
