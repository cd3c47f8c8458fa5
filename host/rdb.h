#pragma once
// The ray distribution buffer on OpenCL: scatter, merge, in memory-bounded passes.
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "coc.h"
#include "lens_cells.h"
#include "opencl/session.h"
#include "rdb_plan.h"

namespace defray {

struct RdbSettings {
  int cells_per_side = 9;
  bool jitter = false;
  std::uint32_t seed = 0;
  std::size_t memory_bytes = std::size_t{512} << 20;  ///< For cells and sums of one pass.
};

/// A frame on its way through the ray distribution buffers. The frame's planes must stay alive and
/// unchanged meanwhile. Passes go through scatter and merge in order.
class RdbRun {
 public:
  /// `channels`: 1 to 4 colour planes.
  RdbRun(Session& session, int width, int height, const std::vector<std::int32_t>& coc_quanta,
         const Plane& depth, const std::vector<Plane>& channels, const RdbSettings& settings);

  const std::vector<RdbPass>& passes() const { return passes_; }

  /// Empties the cells of a pass and scatters into them.
  void scatter(const RdbPass& pass);

  /// Adds the cells of the last scatter to the band's sums; the band's last pass makes the means.
  void merge(const RdbPass& pass);

  /// Copies a finished band's means into `out`, as many planes as there are channels.
  void read_band(const RdbPass& pass, std::vector<Plane>& out);

  /// Winners of the last scatter, [cell][band row][x].
  std::vector<RdbWinner> winners(const RdbPass& pass);

  bool is_last_of_band(const RdbPass& pass) const;
  void finish() { session_.finish(); }

 private:
  /// The source rows that can reach a band, on the device.
  struct Window {
    int band_y = -1;
    cl::Buffer coc, depth, channel[4];
  };
  void view_window(const RdbPass& pass);
  DefrayRdbParams params_of(const RdbPass& pass) const;

  Session& session_;
  int width_;
  const std::vector<std::int32_t>& coc_;
  const Plane& depth_;
  const std::vector<Plane>& channels_;
  std::uint32_t seed_;
  LensCells cells_;
  std::vector<RdbPass> passes_;
  Window window_;
  cl::Buffer lens_, winner_, sum_, filled_;
};

/// The lens picture: 1 to 4 channels in, as many out. `progress` gets the share done, 0 to 1.
std::vector<Plane> render_rdb(Session& session, int width, int height,
                              const std::vector<std::int32_t>& coc_quanta, const Plane& depth,
                              const std::vector<Plane>& channels, const RdbSettings& settings,
                              const std::function<void(double)>& progress = {});

}  // namespace defray
