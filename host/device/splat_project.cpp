// Kernel `splat_project`.
#include <algorithm>

#include "device/device_backend.h"
#include "opencl/launch_table.h"
#include "splat/splats.h"

namespace defray {
namespace {

const LaunchRow splat_project_launch({.kernel = "splat_project", .group = {64, 0}});

}  // namespace

Splats DeviceBackend::splat_project(const Values<DefraySplatNode>& nodes,
                                    const Values<DefraySplatRidge>& ridges,
                                    const DefraySplatParams& params) {
  if (nodes.empty()) return {};
  DefraySplatParams p = params;
  p.count = static_cast<std::uint32_t>(nodes.size());
  Splats splats;
  const cl::Buffer out = session_.out(splats.all, nodes.size());
  const cl::Buffer lines = session_.out(splats.lines, std::max(ridges.size(), std::size_t{1}));
  const std::size_t lanes = session_.uses_vectors() ? DEFRAY_RAY_RUN : 1;
  session_.launch("splat_project", {(nodes.size() + lanes - 1) / lanes}, p, session_.in(nodes),
                  session_.in(ridges), out, lines);
  return splats;
}

}  // namespace defray
