#pragma once
// What the picture shows, with its margin: the stages border, repair and mixed.
#include "chain/chain_work.h"

namespace defray {

class Front {
 public:
  /// `picture` must stay alive.
  Front(const Frame& picture, ChainWork& work);

  /// Whether depth was anti-aliased, and whether there are edges: of all rows.
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
  void sources_to(int end);
  void surfaces_to(int end);
  void move_surfaces(Rows rows);

  const Frame& picture_;
  ChainWork& work_;
  Frame before_;  ///< CoC before anything was repaired.
  Words source_;  ///< Whose surface each pixel has.
  bool is_antialiased_ = false, has_edges_ = false, is_decided_ = false;
  int coc_done_ = 0, sources_done_ = 0, surfaces_done_ = 0, mixed_done_ = 0, kept_ = 0;
};

}  // namespace defray
