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
    for_each_around(at, 1, [&](Place q) {
      is_mixed = is_mixed || std::abs(frame.coc(q) - frame.coc(at)) > DEFRAY_JUMP_QUANTA;
    });
    mixed.push_back(is_mixed);
  });
  return mixed;
}

}  // namespace defray::reference
