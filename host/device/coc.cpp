// Kernel `coc`.
#include "device/device_backend.h"
#include "lens/lens.h"
#include "opencl/launch_table.h"

namespace defray {
namespace {

const LaunchRow coc_launch({.kernel = "coc", .group = {64, 0}});

}  // namespace

Quanta DeviceBackend::coc(const Lens& lens, int display_width_px, const Values<float>& depth) {
  if (depth.empty()) return {};
  const DefrayCocParams p =
      coc_params(lens, display_width_px, static_cast<std::uint32_t>(depth.size()));
  Quanta coc;
  const cl::Buffer in = session_.in(depth), out = session_.out(coc, depth.size());
  session_.launch("coc", {depth.size()}, p, in, out);
  return coc;
}

}  // namespace defray
