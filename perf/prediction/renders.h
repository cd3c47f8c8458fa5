#pragma once
// Renders with their true errors and those that are expected.
#include <array>
#include <string>
#include <vector>

#include "bench.h"
#include "prediction/expected_error.h"
#include "truth/two_truths.h"

namespace defray::perf {

struct PredictedRender {
  std::string scene;  ///< With its setting.
  int width = 0;
  Quality quality = Quality::normal;
  bool sets_model = false;  ///< Else it tests it.
  double true_square = 0;   ///< Mean squared error of shown values.
  ExpectedError expected;
  std::array<double, sign_count> signs{};
  double rank_correlation = 0;  ///< Of the pixels' expected with their true errors.

  double true_db() const;
  /// Expected less true PSNR.
  double off_db() const { return expected.psnr_db - true_db(); }
  bool is_within() const { return true_db() >= expected.low_db && true_db() <= expected.high_db; }
};

/// All four qualities.
std::vector<PredictedRender> predicted_renders(Backend& backend, const Subject& subject,
                                               const TwoTruths& truths);

/// Of the experiment: built-in scenes and random ones, which set the model, and other random ones,
/// which test it, at three sizes.
std::vector<PredictedRender> all_predicted_renders(const Bench& bench);

/// How well renders are predicted: their count, then in dB the median of expected - true, the
/// median of its absolute, what nine in ten stay within, the share inside the interval, and the
/// median rank correlation of pixels.
std::vector<std::string> prediction_columns();
std::vector<std::string> prediction_row(const std::vector<const PredictedRender*>& renders);

}  // namespace defray::perf
