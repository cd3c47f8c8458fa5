// Twin of kernels/methods/tiltshift.cl: the reflected linear gradient of Glatzel & Wilhelm,
// figure 2.
#include <algorithm>
#include <cmath>

#include "kernels/params.h"
#include "reference/twin_backend.h"

namespace defray::reference {

Quanta TwinBackend::tiltshift(const DefrayTiltshiftParams& p) {
  std::vector<std::int32_t> coc;
  coc.reserve(std::size_t{p.width} * p.rows);
  for (std::uint32_t row = 0; row < p.rows; ++row) {
    const float centre = p.first_row_px + static_cast<float>(row) + 0.5f;
    const float beyond = std::max(std::fabs(centre - p.band_centre_px) - p.half_band_px, 0.0f);
    const float radius = std::min(p.slope_quanta_per_px * beyond, p.limit_quanta);
    coc.insert(coc.end(), p.width, static_cast<std::int32_t>(std::nearbyint(radius)));
  }
  return coc;
}

}  // namespace defray::reference
