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

/// "hidden".
const char* to_string(Cause cause);

/// "what was made up behind near surfaces".
const char* about(Cause cause);

/// Names of the signs, in their order.
std::vector<std::string> sign_names();

/// Expected squared errors of a block's shown values, by cause, up to a factor that the frame has
/// in common.
std::array<double, cause_count> squares_of(const SignValues& signs);

/// What that factor is where their mean over the frame, all causes together, is `mean`.
double frame_factor(double mean);

/// Errors below are seen by nobody, and not told apart.
inline constexpr double most_expected_db = 90;

/// PSNR of a mean squared error, and between which it lies in nine of ten cases.
ExpectedError expected_from(double mean_square);

}  // namespace defray
