#pragma once
// Everything that kernels compute, behind one interface: a device runs the kernels
// (device/device_backend.h), and the scalar twins compute the same (reference/twin_backend.h).
#include <limits>
#include <utility>
#include <vector>

#include "defray/report.h"
#include "frame/frame.h"
#include "kernels/methods_params.h"
#include "kernels/patterns_params.h"
#include "kernels/splat_params.h"

namespace defray {

struct GatherSettings;
struct Lens;
struct LightSources;
struct PatternSettings;
struct PatternShift;
struct RayPlan;
struct RayResult;
struct SplatPlanes;
struct Splats;

class Backend {
 public:
  virtual ~Backend() = default;

  /// What the planes of all stages may take together, bytes; stages are asked for bands of rows of
  /// frames that take more.
  virtual std::size_t memory_for_planes() const { return std::numeric_limits<std::size_t>::max(); }

  /// Throws Error(device) if it is known that there is less host memory than a frame needs.
  virtual void require_memory(const Frame&, std::size_t /*bytes*/) {}

  /// Waits for what was asked for.
  virtual void finish() {}

  /// Memory that a device has made so far.
  virtual std::size_t bytes_made() const { return 0; }

#define DEFRAY_CALL(Result, name, parameters) virtual Result name parameters = 0;
#include "frame/backend.def"
#undef DEFRAY_CALL
};

}  // namespace defray
