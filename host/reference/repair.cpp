// Twin of kernels/chain/repair.cl.
#include <array>
#include <cstdlib>

#include "reference/stage_frame.h"

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

Colour minus_part(Colour a, float share, const Colour& b) {
  for (std::size_t c = 0; c < 4; ++c) a[c] -= share * b[c];
  return a;
}

float square_of(const Colour& v) { return v[0] * v[0] + v[1] * v[1] + v[2] * v[2] + v[3] * v[3]; }

/// Whether what is between two pixels in CoC has a colour that is their mean, in depth's shares.
bool mixes(const Frame& f, std::size_t low, std::size_t own, std::size_t high) {
  const Colour base = colour_at(f.channels, low);
  const Colour from_low = minus_part(colour_at(f.channels, own), 1, base);
  const Colour step = minus_part(colour_at(f.channels, high), 1, base);
  const float share = (f.depth[own] - f.depth[low]) / (f.depth[high] - f.depth[low]);
  const auto is_nearest = [&](float part) {
    const float away = square_of(minus_part(from_low, part, step));
    return away < square_of(from_low) && away < square_of(minus_part(from_low, 1, step));
  };
  return is_nearest(share) || is_nearest(share * f.depth[high] / f.depth[own]);
}

std::uint32_t ramp_at(const CocFrame& frame, Place at) {
  constexpr std::array<Place, 4> directions{{{1, 0}, {0, 1}, {1, 1}, {1, -1}}};
  for (const int ahead : {1, 2}) {
    for (const int back : {1, 2}) {
      for (const Place d : directions) {
        const Place low = at - back * d, high = at + ahead * d;
        const Line line{frame.coc(low - d), frame.coc(low), frame.coc(at), frame.coc(high),
                        frame.coc(high + d)};
        if (!line.is_ramp()) continue;
        const Place end = line.is_nearer_low() ? -back * d : ahead * d;
        const auto code = static_cast<std::uint32_t>(1 + (2 + end.x) + 5 * (2 + end.y));
        const bool is_mean =
            mixes(frame.frame, frame.index(low), frame.index(at), frame.index(high));
        return is_mean ? code | DEFRAY_RAMP_MIXES : code;
      }
    }
  }
  return 0;
}

}  // namespace

Words TwinBackend::repair(const Frame& f, Words) {
  const CocFrame frame(f);
  std::vector<std::uint32_t> ramps;
  frame.for_each_place([&](Place at) { ramps.push_back(ramp_at(frame, at)); });
  return ramps;
}

}  // namespace defray::reference
