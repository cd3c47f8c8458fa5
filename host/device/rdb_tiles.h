#pragma once
// A window of a frame made ready for kernel `rdb_gather`: kernels rdb_pad, rdb_tiles, rdb_reach.
#include <array>

#include "device/ray_buffers.h"
#include "opencl/bands.h"
#include "rdb/ray_tiles.h"
#include "rdb/sparse_tiles.h"

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

  /// Kernel `rdb_between` over such rows of the result, whose tiles are the last window's.
  void interpolate(Rows rows, RayResult& out);

  /// Of the last window.
  RayTiles read();

  DefrayRaysParams params{};
  RayWindow planes;  ///< Not padded.
  cl::Buffer keys, largest, sending, coverage, reach, special_rows, sparsity;
  std::array<cl::Buffer, 4> channels;

 private:
  TileWindow tiles() const;
  void find_sparse_tiles();
  std::size_t lines() const { return (params.window_rows + 2 * DEFRAY_RAY_TILE) * params.layers; }

  Session& session_;
  const Frame& frame_;
  const RayPlan& plan_;
  int reach_px_;
  std::vector<BinSet> near_;
  std::vector<std::uint32_t> sparse_tiles_;  ///< What `sparsity` holds.
  cl::Buffer near_on_device_, tiles_, least_;
};

}  // namespace defray
