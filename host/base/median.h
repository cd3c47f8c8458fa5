#pragma once
// The middle of values.
#include <algorithm>
#include <vector>

namespace defray {

/// Of an even number the upper one; puts them into another order. At least one value.
inline double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace defray
