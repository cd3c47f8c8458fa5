// Twins of kernels/chain/mixed.cl.
#include <array>
#include <cstdlib>
#include <optional>

#include "reference/stage_frame.h"
#include "reference/twin_backend.h"

namespace defray::reference {
namespace {

/// Five CoC radii along a line of pixels: two of a surface, one to judge, two of another surface.
struct Line {
  std::int32_t before, low, middle, high, after;

  /// The middle lies between two flat surfaces, a quarter of a pixel from both at least, and not
  /// on a slope: that does not end.
  bool is_ramp() const {
    const int rise = high - low;
    const auto is_on_the_way = [&](int step) {
      return (step > 0) == (rise > 0) && std::abs(step) > std::abs(rise) / 8;
    };
    const auto is_flat = [&](int step) { return std::abs(step) < std::abs(rise) / 8; };
    return std::abs(rise) > DEFRAY_RAMP_QUANTA && is_on_the_way(middle - low) &&
           is_on_the_way(high - middle) && is_flat(low - before) && is_flat(after - high);
  }
  bool is_nearer_low() const { return std::abs(middle - low) <= std::abs(high - middle); }
};

/// The pixel whose depth stands for that of a ramp's pixel.
std::optional<std::size_t> end_of_ramp(const CocFrame& frame, Place at) {
  constexpr std::array<Place, 4> directions{{{1, 0}, {0, 1}, {1, 1}, {1, -1}}};
  for (const int ahead : {1, 2}) {
    for (const int back : {1, 2}) {
      for (const Place d : directions) {
        const Place low = at - back * d, high = at + ahead * d;
        const Line line{frame.coc(low - d), frame.coc(low), frame.coc(at), frame.coc(high),
                        frame.coc(high + d)};
        if (line.is_ramp()) return frame.index(line.is_nearer_low() ? low : high);
      }
    }
  }
  return std::nullopt;
}

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

Words TwinBackend::repair(const Frame& f, Words) {
  const CocFrame frame(f);
  std::vector<std::uint32_t> source;
  frame.for_each_place([&](Place at) {
    const std::size_t pixel = end_of_ramp(frame, at).value_or(frame.index(at));
    source.push_back(static_cast<std::uint32_t>(pixel));
  });
  return source;
}

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
