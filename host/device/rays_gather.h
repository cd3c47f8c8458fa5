#pragma once
// A frame's rays from where they end: kernel rdb_gather.
#include <optional>

#include "device/ray_window.h"
#include "rdb/segments.h"

namespace defray {

/// What RdbRun computes, bit for bit, without jitter.
class RaysGather {
 public:
  /// All must stay alive and unchanged meanwhile.
  RaysGather(Session& session, const Frame& frame, const RayPlan& plan, const LightSources* lights,
             KeptBuffer& winners);

  void run(RayResult& out, const Progress& progress);

 private:
  void gather(int y, int rows, RayResult& out);
  void gather_pass(int first_cell);
  void find_segments(int first_cell);

  Session& session_;
  const Frame& frame_;
  const LensPoints& lens_;
  RadiusBins bins_;
  std::size_t winner_cells_;  ///< 0: nobody wants winners.
  int rows_;                  ///< Most of a band.
  RayBuffers buffers_;
  RayTileWindow window_;
  BinSet sharp_;
  cl::Buffer filled_, segments_, first_, sharp_on_device_;
  std::optional<SegmentTable> table_;  ///< Of the last pass.
  int table_cell_ = -1;                ///< Its first.
};

}  // namespace defray
