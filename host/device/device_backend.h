#pragma once
// The stages as an OpenCL device computes them.
#include "chain/patterns/patterns.h"
#include "device/ray_buffers.h"
#include "frame/backend.h"
#include "opencl/session.h"
#include "rdb/ray_tiles.h"

namespace defray {

/// Every stage runs its kernel, in bands where the frame does not fit the session's memory.
class DeviceBackend : public Backend {
 public:
  /// The session must outlive this.
  explicit DeviceBackend(Session& session) : session_(session) {}

  /// A device with memory of its own takes whole frames, and cuts them itself.
  std::size_t memory_for_planes() const override {
    return session_.works_in_host_memory() ? session_.memory_bytes() : Backend::memory_for_planes();
  }
  void require_memory(const Frame& frame, std::size_t bytes) override;
  void finish() override { session_.finish(); }
  std::size_t bytes_made() const override { return session_.traffic().made; }

#define DEFRAY_CALL(Result, name, parameters) Result name parameters override;
#include "frame/backend.def"
#undef DEFRAY_CALL

  // Kernels by themselves, for their checks.

  /// `patterns_difference` over a whole frame: [shifts][rows of cells][pattern_row_words].
  std::vector<std::uint32_t> patterns_difference(const Frame& frame, const Words& pixels,
                                                 const std::vector<PatternShift>& shifts,
                                                 const PatternSettings& settings);

  /// `gather_tiles`: the largest |CoC| of each tile, quanta; `gather_reach`: how far light comes
  /// from, for each tile.
  Quanta gather_tiles(const Frame& frame);
  Quanta gather_reach(const Frame& frame);

  /// `rdb_pad`, `rdb_tiles`, `rdb_reach` over a whole frame.
  RayTiles ray_tiles(const Frame& frame, const RayPlan& plan);

  /// `light_maps` over a whole frame.
  std::vector<std::uint8_t> light_maps(const Frame& frame, const LightSources& lights);

  Session& session() { return session_; }

 private:
  /// `light_maps` and `highlights_add`: adds the sources' light to the means.
  void add_light(const Frame& frame, const RayPlan& plan, const LightSources& sources,
                 RayResult& out);

  Session& session_;
  KeptBuffer winners_;  ///< From one band of a frame to the next.
};

}  // namespace defray
