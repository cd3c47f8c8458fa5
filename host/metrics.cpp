#include "metrics.h"

#include <algorithm>
#include <cmath>

#include "error.h"
#include "image/ldr.h"

namespace defray {
namespace {

double clipped(float value) { return std::clamp(static_cast<double>(value), 0.0, 1.0); }

/// Peak signal is 1.
double psnr_db(double squared_error_sum, double count) {
  return 10 * std::log10(count / squared_error_sum);
}

}  // namespace

Comparison compare(const std::vector<Plane>& a, const std::vector<Plane>& b, int width) {
  if (a.size() < 3 || b.size() < 3 || a[0].size() != b[0].size()) {
    fail(ExitCode::usage, "pictures to compare differ in size: {} and {} pixels", a[0].size(),
         b[0].size());
  }
  double encoded_sum = 0, linear_sum = 0, raw_sum = 0;
  Comparison result;
  std::size_t worst_at = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t i = 0; i < a[c].size(); ++i) {
      const double linear = clipped(a[c][i]) - clipped(b[c][i]);
      const double encoded = srgb_encode(clipped(a[c][i])) - srgb_encode(clipped(b[c][i]));
      const double raw = static_cast<double>(a[c][i]) - static_cast<double>(b[c][i]);
      encoded_sum += encoded * encoded;
      linear_sum += linear * linear;
      raw_sum += raw * raw;
      if (std::fabs(raw) > result.worst) {
        result.worst = std::fabs(raw);
        worst_at = i;
      }
    }
  }
  const double count = 3 * static_cast<double>(a[0].size());
  result.psnr_srgb_db = psnr_db(encoded_sum, count);
  result.psnr_linear_db = psnr_db(linear_sum, count);
  result.rms = std::sqrt(raw_sum / count);
  result.worst_x = static_cast<int>(worst_at % static_cast<std::size_t>(width));
  result.worst_y = static_cast<int>(worst_at / static_cast<std::size_t>(width));
  return result;
}

}  // namespace defray
