#pragma once
// What lies behind: the stages silhouettes, fill, patterns and feather.
#include <vector>

#include "chain/patterns/patterns.h"
#include "chain/silhouettes/silhouettes.h"
#include "chain/steps/front.h"

namespace defray {

class Behind {
 public:
  /// Both must stay alive. `settings` but for the number of shifts.
  Behind(Front& front, ChainWork& work, const PatternSettings& settings = {});

  /// Where the picture resembles itself: of all rows, or of a frame too large for that, of strips
  /// of it. (The same whatever the memory.)
  void look_at_all();

  /// Works out all rows before `end`.
  void to(int end);

  /// Its rows before `end` are not needed any more; and the first row of the front that it needs.
  void give_back_to(int end);
  int front_needed() const;

  /// Of the rows worked out; `inverse` is negative where nothing is. Shares the planes, which must
  /// stay as they are meanwhile.
  Frame frame() const;

 private:
  void silhouettes_to(int end);
  void fill_to(int end);
  void patterns_to(int end);
  void look_at_strips(const std::vector<Rows>& strips);
  void restart(int y);
  bool has_patterns() const { return work_.settings.hidden == Hidden::patterns; }

  Front& front_;
  ChainWork& work_;
  PatternSettings settings_;
  Silhouettes silhouettes_;
  Frame made_;  ///< Its colours are not feathered.
  Words pixels_;
  std::vector<PatternShift> shifts_;
  Planes feathered_;
  int silhouettes_done_ = 0, fill_done_ = 0, patterns_done_ = 0, done_ = 0;
  int kept_ = 0, kept_made_ = 0, kept_silhouettes_ = 0, kept_pixels_ = 0;
};

/// The strips of a picture of `width` x `height` in which shifts are looked for, from the top; one
/// of all rows where it is small enough.
std::vector<Rows> pattern_strips(int width, int height, const PatternSettings& settings);

}  // namespace defray
