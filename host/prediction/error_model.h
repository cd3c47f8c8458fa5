#pragma once
// From signs to the error that is expected.
#include <string>
#include <vector>

#include "defray/report.h"
#include "prediction/signs.h"

namespace defray {

/// What an expected error comes of.
enum class Cause {
  sampling,  ///< Too few lens points.
  hidden,    ///< Surfaces that were made up.
  edges,     ///< Where surfaces meet, and rims of what is beyond white.
  detail,    ///< What a pixel shows of its surface: the picture's own sampling, approximations.
};
inline constexpr std::size_t cause_count = 4;

/// Of a sign.
Cause cause_of(std::size_t sign);

/// "hidden".
const char* to_string(Cause cause);

/// "what was made up behind near surfaces".
const char* about(Cause cause);

/// How a picture was made, as far as it says what signs weigh.
struct Making {
  int lens_points = 0;
  bool has_patterns = true, is_half_size = false;
};

/// Names of the signs, in their order.
std::vector<std::string> sign_names();

/// By how much of each sign the expected squared error of a picture made so grows, up to a factor
/// that its blocks have in common.
std::array<double, sign_count> weights_of(const Making& making);

using Squares = std::array<double, cause_count>;

/// Expected squared errors of shown values, by cause: signs, weighed.
template <typename Signs>
Squares squares_of(const Signs& signs, const std::array<double, sign_count>& weights) {
  Squares squares{};
  for (std::size_t i = 0; i < sign_count; ++i) {
    squares[static_cast<std::size_t>(cause_of(i))] += weights[i] * double{signs[i]};
  }
  return squares;
}

/// What that factor is where their mean over the frame, all causes together, is `mean`.
double frame_factor(double mean);

/// Errors below are seen by nobody, and not told apart.
inline constexpr double most_expected_db = 90;

/// PSNR of a mean squared error, and between which it lies in nine of ten cases.
ExpectedError expected_from(double mean_square);

}  // namespace defray
