#pragma once
// How far a lens picture is from what a ray tracer would give, expected from how the pictures look:
// no truth is needed. What such errors come of, and how much of it, was learnt from scenes with
// ray-traced truth (perf/README.md, "Predicted error").
#include <array>
#include <string>
#include <vector>

#include "chain/chain.h"
#include "defray/options.h"
#include "defray/report.h"
#include "prediction/error_model.h"

namespace defray {

/// Of a whole frame and, where its planes are wanted, of each block of 4x4 pixels.
class Prediction {
 public:
  /// `result` is what the chain, so set, made of the frame.
  Prediction(const Frame& frame, const ChainSettings& settings, const MethodResult& result,
             bool wants_planes);

  const ExpectedError& of_frame() const { return of_frame_; }

  /// PSNR that other settings of the chain, all its qualities' own, are likely to be expected to
  /// have: by how this picture looks, so about right.
  double guess_db(const ChainSettings& other) const;

  /// RMS errors of sRGB-encoded values that are expected at each pixel: of all causes together,
  /// then of each.
  std::vector<Plane> planes() const;
  /// "total", "sampling", "hidden", "edges", "detail".
  static std::vector<std::string> plane_names();

  /// Means over the frame of what the model weighs, in its order; 0 where it weighs nothing of it.
  std::array<double, sign_count> mean_signs() const;

 private:
  void add_rows(const Frame& frame, const MethodResult& result, Rows rows, bool wants_planes);

  int width_, height_, across_;
  Making making_;
  std::array<double, sign_count> means_{};               ///< Of the signs.
  std::vector<std::array<float, cause_count>> squares_;  ///< A block each, up to the factor.
  double factor_ = 1;
  ExpectedError of_frame_;
};

}  // namespace defray
