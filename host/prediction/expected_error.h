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

/// Of a whole frame and of each block of 4x4 pixels.
class Prediction {
 public:
  /// `result` is what the chain, so set, made of the frame.
  Prediction(const Frame& frame, const ChainSettings& settings, const MethodResult& result);

  const ExpectedError& of_frame() const { return of_frame_; }

  /// PSNR that other settings of the chain, all its qualities' own, are likely to be expected to
  /// have: by how this picture looks, so about right.
  double guess_db(const ChainSettings& other) const;

  /// RMS errors of sRGB-encoded values that are expected at each pixel: of all causes together,
  /// then of each.
  std::vector<Plane> planes() const;
  /// "total", "sampling", "hidden", "edges", "detail".
  static std::vector<std::string> plane_names();

  /// Means over the frame of what the model weighs, in its order.
  std::array<double, sign_count> mean_signs() const;

 private:
  int width_, height_;
  PixelBlocks blocks_;
  std::size_t channels_;
  std::vector<SignValues> signs_;
  double factor_ = 1;
  ExpectedError of_frame_;
};

}  // namespace defray
