// Cases of 'defray validate --case': what is taken is in range, and comes back from its own text.
#include <cmath>

#include "fuzz.h"
#include "validation/case.h"

using namespace defray;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::Bytes bytes(data, size);
  const std::string text = bytes.line();
  fuzz::run_parser([&] {
    const validation::Case c = validation::parse_case(text);
    fuzz::require(c.width > 0 && c.height > 0 && std::int64_t{c.width} * c.height <= 1 << 22);
    fuzz::require(c.coc_px >= 0 && std::isfinite(c.coc_px) && c.focus > 0.05);
    fuzz::require(c.channels >= 1 && c.channels <= 4 && c.cells >= 1 && c.samples >= 1);
    fuzz::require(c.band_rows >= 0 && (c.group_x > 0) == (c.group_y > 0));
    fuzz::require(validation::parse_case(validation::to_string(c)) == c);
  });
  return 0;
}
