#pragma once
// Ray-traced scenes that lie in a folder, as `defray scene` writes them.
#include <string>
#include <vector>

#include "bench.h"

namespace defray::perf {

/// A scene at one focus, and its truth.
struct MeasuredPlace {
  std::string name;
  Subject subject;
  std::vector<Plane> truth;
};

/// Every focus setting of every scene of a folder that has a truth, in order of their names; none
/// where `scenes` is empty.
std::vector<MeasuredPlace> read_places(const Bench& bench, const std::string& scenes);

}  // namespace defray::perf
