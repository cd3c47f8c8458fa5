#pragma once
// Numbers that change over a sequence.
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "defray/options.h"
#include "lens/camera.h"
#include "options/option_text.h"

namespace defray::cli {

/// "3", or "3:1,2.2:24": 3 at frame 1, 2.2 at frame 24, between them a straight line, or with
/// ",smooth" at the end one that begins and ends level; before and after, the nearest's.
class Curve {
 public:
  /// Throws Error(usage) that begins with the option's name.
  Curve(const OptionText& option, const std::string& text);

  bool is_constant() const { return keys_.size() == 1 && !has_frames_; }
  double at(double frame) const;

 private:
  struct Key {
    double frame, value;
  };
  std::vector<Key> keys_;  ///< By frame, each once.
  bool is_smooth_ = false, has_frames_ = false;
};

/// An eye instead of a camera's lens.
struct EyeOptions {
  std::optional<Eye> eye;
  double display_distance_m = 0.6, display_px_per_metre = 3780;  ///< Of Eye::display; 96 dpi.
};

/// What of a frame may change over a sequence.
struct FrameLens {
  CameraValues camera;
  Aperture aperture;
  EyeOptions eye;
  double max_coc_px = Lens().max_coc_px;
};

/// A value that does, and where it goes.
struct AnimatedValue {
  std::string option;
  Curve curve;
  std::function<void(FrameLens&, double)> set;
};
using AnimatedLens = std::vector<AnimatedValue>;

}  // namespace defray::cli
