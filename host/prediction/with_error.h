#pragma once
// A method, and the error that is expected of what it gives; or the error that is wanted, and what
// meets it for the least work.
#include <optional>

#include "chain/quality.h"
#include "methods/method.h"
#include "prediction/expected_error.h"

namespace defray {

/// What a method gave, its settings, and how far it is from the truth.
struct ResultWithError {
  MethodResult result;
  MethodSettings settings;               ///< As used: with the quality that was chosen.
  std::optional<Prediction> prediction;  ///< Where asked for, of the RDB with its stages.
  std::optional<Rung> rung;              ///< Where a target chose it, with
  std::optional<Rung> next_rung = {};    ///< what a sequence's next frame begins with.
  double predict_seconds = 0;

  /// What is expected, beside what was wanted.
  std::optional<ExpectedError> expected(const ErrorSettings& wanted) const;
};

/// Whether errors are expected of what a method makes: of the RDB with the stages that the model
/// was learnt with, and no fewer lens points.
bool is_predictable(const MethodSettings& method);

/// Throws Error(usage) naming the field: a target that is no PSNR, or planes or a target of what is
/// not predictable.
void validate(const MethodSettings& method, const ErrorSettings& error);

/// apply_method. With a target: the fastest of the rungs, or what the frame before says, then the
/// next that is likely to meet it, until one is expected to; the last if none is. What pictures
/// hold decides, nothing else.
ResultWithError apply_with_error(const Frame& frame, const MethodSettings& settings,
                                 const ErrorSettings& error, Backend& backend, bool wants_nearest,
                                 const Progress& progress);

}  // namespace defray
