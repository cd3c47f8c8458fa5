#pragma once
// The methods, behind one call: a frame with its circles of confusion in, the lens picture out.
#include <functional>
#include <optional>
#include <vector>

#include "chain/defocus.h"
#include "methods/gather.h"
#include "methods/linear.h"
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
  std::optional<DefocusSettings> defocus;
  LinearSettings linear;  ///< Of tiltshift too.
  GatherSettings gather;
};

/// A frame before the lens.
struct PinholeFrame {
  int width, height;
  const std::vector<std::int32_t>& coc_quanta;
  const Plane& depth;                  ///< Planar, > 0; only the RDB reads it.
  const std::vector<Plane>& channels;  ///< 1 to 4.
  bool has_alpha = false;              ///< The last channel is alpha.
  /// Where the frame lies in the display window, and that window's size; 0: the frame itself.
  int origin_x = 0, origin_y = 0, display_width = 0, display_height = 0;
};

/// The lens picture, as many channels as there are. `session` null: the scalar twins.
/// `progress` gets the share done, 0 to 1. Throws Error(usage) for settings out of range.
/// `details` gets what the RDB's stages tell beside the picture; of the RDB alone, nearest hits.
std::vector<Plane> apply_method(const PinholeFrame& frame, const MethodSettings& settings,
                                Session* session, const std::function<void(double)>& progress = {},
                                DefocusResult* details = nullptr);

}  // namespace defray
