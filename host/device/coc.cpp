// Kernel `coc`.
#include <algorithm>

#include "device/device_backend.h"
#include "lens/lens.h"
#include "opencl/launch_table.h"

namespace defray {
namespace {

const LaunchRow coc_launch({.kernel = "coc", .group = {64, 0}});

/// Of a plane that no buffer holds, a part after the other.
Quanta coc_in_parts(Session& session, const Lens& lens, int display_width_px,
                    std::span<const float> depth, std::size_t most) {
  std::vector<std::int32_t> coc(depth.size());
  for (std::size_t first = 0; first < depth.size(); first += most) {
    const std::size_t count = std::min(most, depth.size() - first);
    const DefrayCocParams p = coc_params(lens, display_width_px, static_cast<std::uint32_t>(count));
    const cl::Buffer in = session.view(&depth[first], count * sizeof(float));
    const cl::Buffer out = session.write_view(&coc[first], count * sizeof(std::int32_t));
    session.launch("coc", {count}, p, in, out);
    session.bring(out, count, &coc[first]);
  }
  return coc;
}

}  // namespace

Quanta DeviceBackend::coc(const Lens& lens, int display_width_px, const Values<float>& depth) {
  if (depth.empty()) return {};
  const std::size_t most = session_.info().max_buffer_bytes / sizeof(float);
  if (depth.size() > most) {
    return coc_in_parts(session_, lens, display_width_px, depth.host(), most);
  }
  const DefrayCocParams p =
      coc_params(lens, display_width_px, static_cast<std::uint32_t>(depth.size()));
  Quanta coc;
  const cl::Buffer in = session_.in(depth), out = session_.out(coc, depth.size());
  session_.launch("coc", {depth.size()}, p, in, out);
  return coc;
}

}  // namespace defray
