#pragma once
// A window of a frame made ready for kernel `rdb_gather`: kernels rdb_pad, rdb_tiles, rdb_reach.
#include <array>

#include "device/ray_buffers.h"
#include "opencl/bands.h"
#include "rdb/ray_tiles.h"

namespace defray {

/// Its parameters but for the band; its planes; what its tiles hold.
class RayTileWindow {
 public:
  /// All must stay alive and unchanged meanwhile.
  RayTileWindow(Session& session, const Frame& frame, const RayPlan& plan, const RadiusBins& bins);

  /// Windows that fit the session's memory, with the rows that they are for.
  std::vector<BandRows> windows() const;

  /// Makes a window ready.
  void prepare(const BandRows& rows);

  /// Of the last window.
  RayTiles read();

  DefrayRaysParams params{};
  RayWindow planes;  ///< Not padded.
  cl::Buffer keys, largest, sending, coverage, reach;
  std::array<cl::Buffer, 4> channels;

 private:
  std::size_t lines() const { return (params.window_rows + 2 * DEFRAY_RAY_ROWS) * params.layers; }

  Session& session_;
  const Frame& frame_;
  int reach_px_;
  std::vector<BinSet> near_;
  cl::Buffer near_on_device_, tiles_;
};

}  // namespace defray
