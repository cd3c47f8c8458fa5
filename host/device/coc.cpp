// Kernels `coc` and `tiltshift`.
#include "base/error.h"
#include "device/device_backend.h"
#include "lens/lens.h"
#include "opencl/launch_table.h"

namespace defray {
namespace {

const LaunchRow coc_launch({.kernel = "coc", .group = {64, 0}});
const LaunchRow tiltshift_launch({.kernel = "tiltshift", .group = {64, 1}});

}  // namespace

void DeviceBackend::require_memory(const Frame& f, std::size_t bytes) {
  // Of host memory only a device that shares it tells how much there is.
  const DeviceInfo& device = session_.info();
  if (!device.shares_host_memory || bytes <= device.global_memory_bytes) return;
  fail(
      ErrorKind::device,
      "{}x{} pixels: the stages of rdb need about {} MiB of host memory, {} has {} MiB; {} needs a "
      "third",
      f.width, f.height, bytes >> 20, device.name, device.global_memory_bytes >> 20,
      field("literal"));
}

Quanta DeviceBackend::coc(const Lens& lens, int display_width_px, const Values<float>& depth) {
  if (depth.empty()) return {};
  const DefrayCocParams p =
      coc_params(lens, display_width_px, static_cast<std::uint32_t>(depth.size()));
  Quanta coc;
  const cl::Buffer in = session_.in(depth), out = session_.out(coc, depth.size());
  session_.launch("coc", {depth.size()}, p, in, out);
  return coc;
}

Quanta DeviceBackend::tiltshift(const DefrayTiltshiftParams& p) {
  Quanta coc;
  const cl::Buffer out = session_.out(coc, std::size_t{p.width} * p.rows);
  session_.launch("tiltshift", {p.width, p.rows}, p, out);
  return coc;
}

}  // namespace defray
