#pragma once
// What the picture shows, with its margin: the stages border, repair and mixed.
#include "chain/plan/chain_work.h"
#include "chain/steps/antialiased.h"

namespace defray {

class Front {
 public:
  /// `picture` must stay alive.
  Front(const Frame& picture, ChainWork& work);

  /// Where depth was anti-aliased, and whether there are edges: of all rows.
  void look_at_all();

  /// Works out all rows before `end`.
  void to(int end);

  /// Rows before `end` are not needed any more.
  void give_back_to(int end);

  /// Goes on from row `y`, a multiple of band_step, with nothing before it.
  void restart(int y);

  bool has_edges() const { return has_edges_; }

  Frame frame;  ///< CoC, `inverse`, colours, data.
  Words mixed;

 private:
  void coc_to(int end);
  void ramps_to(int end);
  void surfaces_to(int end);
  std::size_t count_mixed();
  void look_for_ramps();
  void move_surfaces(Rows rows);

  const Frame& picture_;
  ChainWork& work_;
  Words ramps_;  ///< Of the picture: what `repair` says.
  Antialiased antialiased_;
  bool is_repaired_ = false, has_edges_ = false;
  int coc_done_ = 0, ramps_done_ = 0, surfaces_done_ = 0, mixed_done_ = 0;
  int kept_ = 0, ramps_kept_ = 0;
};

}  // namespace defray
