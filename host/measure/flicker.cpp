#include "measure/flicker.h"

#include <cmath>

namespace defray {

Flicker flicker(const std::vector<Plane>& result, const std::vector<Plane>& next_result,
                const std::vector<Plane>& truth, const std::vector<Plane>& next_truth) {
  for (const auto* picture : {&next_result, &truth, &next_truth}) {
    require_same_size(result, *picture);
  }
  constexpr std::size_t rgb = 3;
  double error_sum = 0, truth_sum = 0;
  for (std::size_t c = 0; c < rgb; ++c) {
    for (std::size_t i = 0; i < truth[c].size(); ++i) {
      const double wanted = shown_value(next_truth[c][i]) - shown_value(truth[c][i]);
      const double error = shown_value(next_result[c][i]) - shown_value(result[c][i]) - wanted;
      error_sum += error * error;
      truth_sum += wanted * wanted;
    }
  }
  const double count = static_cast<double>(rgb * truth[0].size());
  return {std::sqrt(error_sum / count), std::sqrt(truth_sum / count)};
}

}  // namespace defray
