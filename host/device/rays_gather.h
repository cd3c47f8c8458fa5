#pragma once
// A frame's rays from where they end: kernel rdb_gather.
#include "device/ray_window.h"
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
  void gather(int y, int rows, RayResult& out);

  Session& session_;
  const Frame& frame_;
  std::size_t winner_cells_;  ///< 0: nobody wants winners.
  int rows_;                  ///< Most of a band.
  RayBuffers buffers_;
  RayTileWindow window_;
  BinSet sharp_;
  cl::Buffer segments_, first_, sharp_on_device_;
};

}  // namespace defray
