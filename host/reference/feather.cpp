// Twin of kernels/chain/feather.cl.
#include <cstdlib>

#include "reference/stage_frame.h"

namespace defray::reference {
namespace {

class Feather {
 public:
  Feather(const Frame& behind, const Quanta& seen, const Words& marks, const Words& strips)
      : frame_(behind),
        seen_(seen.host()),
        inverse_(behind.inverse.host()),
        marks_(marks.host()),
        strips_(strips.host()) {}

  bool is_there(Place at) const { return frame_.contains(at) && inverse_[frame_.index(at)] >= 0; }

  /// Whether a square holds neighbours of two surfaces neither of which a silhouette is drawn on.
  bool is_at_edge(Place middle) const {
    bool is_edge = false;
    for_each_around(middle, reach, [&](Place at) {
      const Place right{at.x + 1, at.y}, below{at.x, at.y + 1};
      is_edge |= right.x <= middle.x + reach && are_parted(at, right);
      is_edge |= below.y <= middle.y + reach && are_parted(at, below);
    });
    return is_edge;
  }

  /// Of the square's colours to that in its middle, whose surface has its own where it is seen.
  Colour mean_difference(Place middle) const {
    const Planes& channels = frame_.frame.channels;
    const Colour own = colour_at(channels, frame_.index(middle));
    Colour sum{};
    float weights = 0;
    for_each_around(middle, reach, [&](Place at) {
      if (!is_there(at)) return;
      const Place d = at - middle;
      const auto weight = static_cast<float>(DEFRAY_FEATHER_WEIGHT - d.x * d.x - d.y * d.y);
      weights += weight;
      if (!are_two(frame_.coc(middle), tame(seen_[frame_.index(at)]))) return;
      Colour difference = colour_at(channels, frame_.index(at));
      add(difference, -1, own);
      add(sum, weight, difference);
    });
    return divided(sum, weights);
  }

 private:
  static constexpr int reach = DEFRAY_FEATHER_PX;

  bool is_drawn(std::size_t pixel) const {
    return marks_[pixel] & DEFRAY_SILHOUETTE || strips_[pixel] != 0;
  }
  bool are_parted(Place a, Place b) const {
    return is_there(a) && is_there(b) && !is_drawn(frame_.index(a)) && !is_drawn(frame_.index(b)) &&
           are_two(frame_.coc(a), frame_.coc(b));
  }
  static bool are_two(std::int32_t a, std::int32_t b) {
    return std::abs(a - b) > DEFRAY_JUMP_QUANTA;
  }

  CocFrame frame_;
  std::span<const std::int32_t> seen_;
  std::span<const float> inverse_;
  std::span<const std::uint32_t> marks_, strips_;
};

}  // namespace

Planes TwinBackend::feather(const Frame& behind, const Quanta& seen, const Words& marks,
                            const Words& strips, Planes) {
  std::vector<Plane> out = planes_of(behind.channels);
  const Feather feather(behind, seen, marks, strips);
  CocFrame(behind).for_each_place([&](Place at) {
    if (!feather.is_there(at) || !feather.is_at_edge(at)) return;
    const Colour difference = feather.mean_difference(at);
    for (std::size_t c = 0; c < out.size(); ++c) {
      float& own = out[c][behind.index(at.x, at.y)];
      const float mean = own + difference[c];
      if (difference[c] != 0 && std::isfinite(mean)) own = mean;  // -0 stays -0
    }
  });
  return out;
}

}  // namespace defray::reference
