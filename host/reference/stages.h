#pragma once
// The scalar twins of the stages before the ray distribution buffers: host/stages.h without a
// device. Floats are added in the kernels' order: equal bits.
#include <cstdint>
#include <vector>

#include "chain/stages.h"

namespace defray::reference {

/// Twin of kernel `repair`.
std::vector<std::uint32_t> repair(int width, int height,
                                  const std::vector<std::int32_t>& coc_quanta);

/// Twin of kernel `edges`.
std::vector<std::uint32_t> edges(int width, int height,
                                 const std::vector<std::int32_t>& coc_quanta);

/// Twin of kernel `fill`. It looks behind every pixel, in whatever tile.
Surface fill(const FrameView& frame, const std::vector<std::uint32_t>& mixed);

/// Twin of kernel `split`.
Surfaces split(const FrameView& frame, const std::vector<std::uint32_t>& mixed, Surface behind);

/// Twin of kernel `soften`.
std::vector<Plane> soften(const Fragments& fragments, int samples);

}  // namespace defray::reference
