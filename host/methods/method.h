#pragma once
// The methods, behind one call: a frame with its circles of confusion in, the lens picture out.
#include <optional>
#include <vector>

#include "chain/chain.h"
#include "frame/stages.h"
#include "methods/gather.h"
#include "rdb/rdb.h"

namespace defray {

enum class Method {
  rdb,        ///< Ray distribution buffer (Shinya 1994).
  linear,     ///< Each pixel spread over its PSF (Potmesil & Chakravarty 1981).
  gather,     ///< Poisson-disk gather (Glatzel & Wilhelm).
  tiltshift,  ///< A mean with `linear`'s weights, its CoC from the pixel's row: no depth.
};

/// "rdb", as on the command line.
const char* to_string(Method method);

struct MethodSettings {
  Method method = Method::rdb;
  RdbSettings rdb;
  /// rdb: with the stages that bring it closer to the truth. Empty: Shinya's method alone.
  std::optional<ChainSettings> chain;
  GatherSettings gather;
};

/// The lens picture, as many channels as there are, and what the method tells beside it. `frame`
/// has coc_quanta, channels and, for the RDB, depth. Throws Error(usage) for settings out of range.
MethodResult apply_method(const Frame& frame, const MethodSettings& settings, Stages& stages,
                          bool wants_nearest = false, const Progress& progress = {});

}  // namespace defray
