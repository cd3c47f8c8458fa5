#pragma once
// A frame on its way through the ray distribution buffers: scatter, merge, in passes that fit the
// session's memory.
#include <array>
#include <optional>
#include <vector>

#include "frame/stages.h"
#include "opencl/session.h"
#include "rdb/light_sources.h"
#include "rdb/rdb.h"
#include "rdb/rdb_plan.h"

namespace defray {

/// The frame's planes must stay alive and unchanged meanwhile. Passes go through scatter and merge
/// in order.
class RdbRun {
 public:
  /// `lights`, if any, must stay alive too: all cells of a band are then in one pass.
  RdbRun(Session& session, const Frame& frame, const RayPlan& plan,
         const LightSources* lights = nullptr);

  const std::vector<RdbPass>& passes() const { return passes_; }

  /// Empties the cells of a pass and scatters into them.
  void scatter(const RdbPass& pass);

  /// Adds the cells of the last scatter to the band's sums; the band's last pass makes the means.
  void merge(const RdbPass& pass);

  /// Looks for the nearest hit among the cells of the last scatter.
  void nearest(const RdbPass& pass);

  /// Adds the light sources to the band's means.
  void add_light(const RdbPass& pass);

  /// Copies a finished band's part of the result.
  void read_band(const RdbPass& pass, RayResult& out);

  /// Winners of the last scatter, [cell][band row][x], and the frame's surface that their source 0
  /// stands for.
  std::vector<RdbWinner> winners(const RdbPass& pass);
  std::size_t first_source(const RdbPass& pass) const;

  bool is_last_of_band(const RdbPass& pass) const;
  void finish() { session_.finish(); }

 private:
  /// The source rows that can reach a band, on the device; all rows where they fit.
  struct Window {
    int band_y = -1;
    cl::Buffer coc, depth, coverage, data_of;
    std::array<cl::Buffer, 4> channels;
  };
  struct Light {
    cl::Buffer first, list, where, excess, table, cell_map;
  };
  void view_window(const RdbPass& pass);
  DefrayRdbParams params_of(const RdbPass& pass) const;
  int window_y(const RdbPass& pass) const { return holds_frame_ ? 0 : pass.window_y; }

  Session& session_;
  const Frame& frame_;
  const RayPlan& plan_;
  bool holds_frame_;
  std::vector<RdbPass> passes_;
  Window window_;
  cl::Buffer lens_, rim_x_, rim_y_, winner_, sum_, filled_, seen_, nearest_;
  const LightSources* lights_;
  Light light_;
};

}  // namespace defray
