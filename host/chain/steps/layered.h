#pragma once
// The surfaces that rays come from, in one or two layers: the stages split, highlights, what goes
// on in the margin, and soften.
#include <vector>

#include "chain/steps/behind.h"
#include "rdb/light_sources.h"

namespace defray {

class Layered {
 public:
  /// All must stay alive.
  Layered(Front& front, Behind& behind, ChainWork& work);

  /// Works out all rows before `end`.
  void to(int end);

  /// With softened colours; shares the planes, which must stay as they are meanwhile.
  Frame frame_for_rays(Rows rows) const;
  LightSources lights_for_rays(const Frame& frame) const;

  /// Rays for rows before `end` have been sent.
  void give_back_to(int end);

  const LightSources& lights() const { return lights_; }

 private:
  bool has_two() const { return work_.settings.hidden != Hidden::off && front_.has_edges(); }
  Frame& frame() { return has_two() ? layers_ : front_.frame; }
  const Frame& frame() const { return has_two() ? layers_ : front_.frame; }
  int height() const { return front_.frame.height; }
  int light_channels() const;
  bool has_alpha() const { return front_.frame.has_alpha; }

  void split_to(int end);
  void split(Rows rows);
  void describe(Rows rows);
  void highlights_to(int end);
  void lights_to(int end);
  void margin_to(int end);

  Front& front_;
  Behind& behind_;
  ChainWork& work_;
  Frame layers_;  ///< Two of them.
  Words none_mixed_;
  std::vector<CocRange> rows_range_;  ///< Of each row.
  Values<float> kept_, alpha_;        ///< Of highlights; before anything was taken from it.
  LightSources lights_;               ///< Not sorted into tiles.
  Planes softened_;
  int split_done_ = 0, highlights_done_ = 0, lights_done_ = 0, margin_done_ = 0, soften_done_ = 0;
  int kept_rows_ = 0, kept_colours_ = 0, kept_shares_ = 0, kept_softened_ = 0;
};

}  // namespace defray
