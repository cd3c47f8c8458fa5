#pragma once
// The scalar twins: every kernel once more, written from the papers' formulas and not from the
// kernels. They define what a kernel must compute; they run where there is no device. Floats are
// added in the kernels' order: equal bits.
#include <cstdint>
#include <vector>

#include "chain/patterns.h"
#include "frame/stages.h"
#include "methods/gather.h"

namespace defray::reference {

class TwinStages : public Stages {
 public:
  Quanta coc(const Lens& lens, int display_width_px, const Values<float>& depth) override;
  Quanta tiltshift(const DefrayTiltshiftParams& params) override;
  Words repair(const Frame& frame) override;
  Words edges(const Frame& frame) override;
  /// It looks behind every pixel, in whatever tile.
  Frame fill(const Frame& frame, const Words& mixed) override;
  PatternSums patterns(const Frame& frame, const Frame& behind, const Words& pixels,
                       const std::vector<PatternShift>& shifts,
                       const PatternSettings& settings) override;
  Surfaces split(const Frame& frame, const Words& mixed, Frame behind) override;
  Frame assemble(const Surfaces& surfaces) override;
  Values<float> highlights(const Frame& frame, int light_channels) override;
  Planes soften(const Frame& frame, int lens_points) override;
  RayResult rays(const Frame& frame, const RayPlan& plan, const LightSources* lights = nullptr,
                 const Progress& progress = {}) override;
  std::vector<Plane> linear(const Frame& frame, const Progress& progress = {}) override;
  std::vector<Plane> gather(const Frame& frame, const GatherSettings& settings,
                            const Progress& progress = {}) override;
};

}  // namespace defray::reference
