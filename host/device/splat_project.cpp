// Kernel `splat_project`.
#include "device/device_backend.h"
#include "opencl/launch_table.h"

namespace defray {
namespace {

const LaunchRow splat_project_launch({.kernel = "splat_project", .group = {64, 0}});

}  // namespace

Values<DefraySplat> DeviceBackend::splat_project(const Values<DefraySplatNode>& nodes,
                                                 const DefraySplatParams& params) {
  if (nodes.empty()) return {};
  DefraySplatParams p = params;
  p.count = static_cast<std::uint32_t>(nodes.size());
  Values<DefraySplat> splats;
  const cl::Buffer out = session_.out(splats, nodes.size());
  const std::size_t lanes = session_.uses_vectors() ? DEFRAY_RAY_RUN : 1;
  session_.launch("splat_project", {(nodes.size() + lanes - 1) / lanes}, p, session_.in(nodes),
                  out);
  return splats;
}

}  // namespace defray
