#pragma once
// Frames of patterns for `defray validate`.
#include "base/random.h"
#include "chain/patterns/patterns.h"
#include "validation/input.h"

namespace defray::validation {

inline constexpr int shift_count = 4;

int window_of(const Case& c);

/// A frame of patterns made from a case's colours and radii.
class PatternCase {
 public:
  /// `hides_everything`: a fragment behind every pixel, so that all of a kernel's output counts.
  PatternCase(const Case& c, const Input& in, bool hides_everything);

 private:
  void add_pixel(Random random, const Input& in, bool hides_everything);
  void add_shifts(const Case& c);

  std::vector<std::uint32_t> encoded_;
  std::vector<bool> behind_;
  Plane inverse_, behind_inverse_;

 public:
  Frame frame, behind;
  PatternSettings settings;
  std::vector<PatternShift> shifts;
  Words pixels;
};

}  // namespace defray::validation
