#pragma once
// A frame's rays from where they end: kernels rdb_pad, rdb_tiles, rdb_reach, rdb_gather.
#include <array>
#include <vector>

#include "device/ray_buffers.h"
#include "opencl/bands.h"
#include "rdb/segments.h"

namespace defray {

/// What RdbRun computes, bit for bit, without jitter.
class RaysGather {
 public:
  /// All must stay alive and unchanged meanwhile.
  RaysGather(Session& session, const Frame& frame, const RayPlan& plan, const RadiusBins& bins,
             const SegmentTable& table, const LightSources* lights);

  void run(RayResult& out, const Progress& progress);

 private:
  std::vector<BandRows> windows() const;
  void prepare(const BandRows& window);
  void find_tiles();
  void gather(int y, int rows, RayResult& out);

  Session& session_;
  const Frame& frame_;
  int reach_px_;
  std::size_t winner_cells_;  ///< 0: nobody wants winners.
  int rows_;                  ///< Most of a band.
  RayBuffers buffers_;
  DefrayRaysParams params_{};
  RayWindow window_;
  cl::Buffer segments_, first_, sharp_, near_;
  cl::Buffer keys_, sending_, coverage_, reach_;  ///< Padded, of the window.
  std::array<cl::Buffer, 4> channels_;
};

}  // namespace defray
