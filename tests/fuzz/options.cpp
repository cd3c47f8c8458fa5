// Option values: lines are --unit, --background and --work-group.
#include <cmath>

#include "fuzz.h"
#include "options/parse.h"

using namespace defray;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::Bytes bytes(data, size);
  const std::string unit = bytes.line(), background = bytes.line(), group = bytes.line();
  fuzz::run_parser([&] { fuzz::require(cli::parse_unit(unit) > 0); });
  fuzz::run_parser([&] { fuzz::require(!std::isnan(cli::parse_background(background))); });
  fuzz::run_parser([&] {
    for (const auto& [kernel, x, y] : cli::parse_work_groups(group)) {
      fuzz::require(x > 0 && y > 0 && x < 1000000 && y < 1000000);
      fuzz::require(group.find(kernel) != std::string::npos);
    }
  });
  return 0;
}
