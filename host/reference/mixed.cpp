// Twin of kernels/chain/mixed.cl.
#include <cstdlib>

#include "reference/stage_frame.h"
#include "reference/twin_backend.h"

namespace defray::reference {
namespace {

/// Whether a pixel and its neighbour lie on two surfaces, and not on one that slants.
bool parts(const CocFrame& frame, Place at, Place d) {
  const int before = frame.coc(at) - frame.coc(at - d);
  const int step = frame.coc(at + d) - frame.coc(at);
  const int after = frame.coc(at + 2 * d) - frame.coc(at + d);
  const bool is_straight =
      std::abs(step - before) <= DEFRAY_BEND_QUANTA || std::abs(after - step) <= DEFRAY_BEND_QUANTA;
  return std::abs(step) > (is_straight ? DEFRAY_RAMP_QUANTA : DEFRAY_JUMP_QUANTA);
}

}  // namespace

Words TwinBackend::mixed(const Frame& f, Words) {
  const CocFrame frame(f);
  std::vector<std::uint32_t> mixed;
  frame.for_each_place([&](Place at) {
    bool is_mixed = false;
    for_each_around({0, 0}, 1, [&](Place d) { is_mixed = is_mixed || parts(frame, at, d); });
    mixed.push_back(is_mixed);
  });
  return mixed;
}

}  // namespace defray::reference
