#pragma once
// The stages as an OpenCL device computes them.
#include "chain/patterns.h"
#include "frame/backend.h"
#include "opencl/session.h"
#include "rdb/ray_tiles.h"

namespace defray {

/// Every stage runs its kernel, in bands where the frame does not fit the session's memory.
class DeviceBackend : public Backend {
 public:
  /// The session must outlive this.
  explicit DeviceBackend(Session& session) : session_(session) {}

  void require_memory(const Frame& frame, std::size_t bytes) override;
  Quanta coc(const Lens& lens, int display_width_px, const Values<float>& depth) override;
  Quanta tiltshift(const DefrayTiltshiftParams& params) override;
  Words repair(const Frame& frame) override;
  Words mixed(const Frame& frame) override;
  std::size_t bytes_made() const override { return session_.traffic().made; }
  Frame fill(const Frame& frame, const Words& mixed, int directions) override;
  Frame patterns(const Frame& frame, Frame behind, const Words& pixels, const Plane& variance,
                 const std::vector<PatternShift>& shifts, const PatternSettings& settings) override;
  Surfaces split(const Frame& frame, const Words& mixed, Frame behind) override;
  Frame assemble(const Surfaces& surfaces) override;
  Values<float> highlights(const Frame& frame, int light_channels) override;
  Planes soften(const Frame& frame, int lens_points) override;
  RayResult rays(const Frame& frame, const RayPlan& plan, const LightSources* lights = nullptr,
                 const Progress& progress = {}) override;
  std::vector<Plane> linear(const Frame& frame, const Progress& progress = {}) override;
  std::vector<Plane> gather(const Frame& frame, const GatherSettings& settings,
                            const Progress& progress = {}) override;

  // Kernels by themselves, for their checks.

  /// `patterns_difference` over a whole frame: [shifts][rows of cells][pattern_row_words].
  std::vector<std::uint32_t> patterns_difference(const Frame& frame, const Words& pixels,
                                                 const std::vector<PatternShift>& shifts,
                                                 const PatternSettings& settings);

  /// `gather_tiles`: the largest |CoC| of each tile, quanta; `gather_reach`: how far light comes
  /// from, for each tile.
  std::vector<std::int32_t> gather_tiles(const Frame& frame);
  std::vector<std::int32_t> gather_reach(const Frame& frame);

  /// `rdb_pad`, `rdb_tiles`, `rdb_reach` over a whole frame.
  RayTiles ray_tiles(const Frame& frame, const RayPlan& plan);

  Session& session() { return session_; }

 private:
  Session& session_;
};

}  // namespace defray
