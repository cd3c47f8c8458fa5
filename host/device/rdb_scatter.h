#pragma once
// A frame on its way through the ray distribution buffers: scatter, merge, in passes that fit the
// session's memory.
#include <vector>

#include "device/ray_buffers.h"
#include "rdb/rdb_plan.h"

namespace defray {

/// The frame's planes must stay alive and unchanged meanwhile. Passes go through scatter and merge
/// in order.
class RdbScatter {
 public:
  RdbScatter(Session& session, const Frame& frame, const RayPlan& plan);

  /// All passes, one after the other.
  void run(RayResult& out, const Progress& progress);

  const std::vector<RdbPass>& passes() const { return passes_; }

  /// Empties the cells of a pass and scatters into them.
  void scatter(const RdbPass& pass);

  /// Adds the cells of the last scatter to the band's sums; the band's last pass makes the means.
  /// Then the nearest hits.
  void merge(const RdbPass& pass);

  /// Before a band's first pass, and after its last: its part of the result is there.
  void begin_band(const RdbPass& pass, RayResult& out) { buffers_.begin(params_of(pass), out); }
  void end_band(const RdbPass& pass, RayResult& out) { buffers_.read(params_of(pass), out); }

  /// Winners of the last scatter, [cell][band row][x], and the frame's surface that their source 0
  /// stands for.
  std::vector<RdbWinner> winners(const RdbPass& pass);
  std::size_t first_source(const RdbPass& pass) const;

  bool is_last_of_band(const RdbPass& pass) const;
  void finish() { session_.finish(); }

 private:
  void view_window(const RdbPass& pass);
  DefrayRdbParams params_of(const RdbPass& pass) const;
  int window_y(const RdbPass& pass) const { return holds_frame_ ? 0 : pass.window_y; }

  Session& session_;
  const Frame& frame_;
  std::size_t cells_;
  bool holds_frame_;
  std::vector<RdbPass> passes_;
  KeptBuffer winners_;
  RayBuffers buffers_;
  RayWindow window_;
  int window_band_y_ = -1;
  cl::Buffer filled_;
};

}  // namespace defray
