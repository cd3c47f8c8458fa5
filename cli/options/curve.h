#pragma once
// Numbers that change over a sequence.
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lens/camera.h"

namespace defray::cli {

/// "3", or "3:1,2.2:24": 3 at frame 1, 2.2 at frame 24, between them a straight line, or with
/// ",smooth" at the end one that begins and ends level; before and after, the nearest's.
class Curve {
 public:
  /// Throws Error(usage) that begins with the option's name.
  Curve(const std::string& option, const std::string& text);

  bool is_constant() const { return keys_.size() == 1 && !has_frames_; }
  double at(double frame) const;

 private:
  struct Key {
    double frame, value;
  };
  std::vector<Key> keys_;  ///< By frame, each once.
  bool is_smooth_ = false, has_frames_ = false;
};

using CameraField = std::optional<double> CameraValues::*;

/// Lens values that change.
struct AnimatedField {
  CameraField field;
  std::string option;
  Curve curve;
};
using AnimatedLens = std::vector<AnimatedField>;

}  // namespace defray::cli
