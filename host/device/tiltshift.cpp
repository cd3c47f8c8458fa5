// Kernel `tiltshift`.
#include "device/device_backend.h"
#include "opencl/launch_table.h"

namespace defray {
namespace {

const LaunchRow tiltshift_launch({.kernel = "tiltshift", .group = {64, 1}});

}  // namespace

Quanta DeviceBackend::tiltshift(const DefrayTiltshiftParams& p) {
  Quanta coc;
  const cl::Buffer out = session_.out(coc, std::size_t{p.width} * p.rows);
  session_.launch("tiltshift", {p.width, p.rows}, p, out);
  return coc;
}

}  // namespace defray
