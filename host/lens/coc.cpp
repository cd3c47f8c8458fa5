#include "lens/coc.h"

#include <algorithm>
#include <cstdlib>

namespace defray {

std::vector<std::int32_t> coc_on_device(Session& session, const Lens& lens, int display_width_px,
                                        const Plane& depth) {
  std::vector<std::int32_t> coc(depth.size());
  constexpr std::size_t chunk = std::size_t{1} << 24;  // bounds the device's memory
  for (std::size_t first = 0; first < depth.size(); first += chunk) {
    const std::size_t count = std::min(chunk, depth.size() - first);
    const DefrayCocParams p = coc_params(lens, display_width_px, static_cast<std::uint32_t>(count));
    const cl::Buffer in = session.picture(depth.data() + first, count);
    const cl::Buffer out = session.buffer(count * sizeof(std::int32_t));
    session.launch("coc", DEFRAY_COC_GROUP, {count}, p, in, out);
    session.read(out, coc.data() + first, count * sizeof(std::int32_t));
  }
  return coc;
}

std::int32_t largest_coc(const std::vector<std::int32_t>& coc_quanta) {
  std::int32_t largest = 0;
  for (const std::int32_t q : coc_quanta) largest = std::max(largest, std::abs(q));
  return largest;
}

}  // namespace defray
