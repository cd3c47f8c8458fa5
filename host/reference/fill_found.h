#pragma once
// What the twin of `fill` finds behind a pixel, way by way (kernels/chain/fill_walk.clh,
// fill_found.clh).
#include <limits>
#include <numbers>
#include <optional>

#include "reference/stage_frame.h"

namespace defray::reference {

/// A surface behind, met on the way over the picture.
struct Found {
  std::size_t source;
  float distance;  ///< In pixels.
  float met;       ///< CoC there, quanta.
  float coc;       ///< CoC, and
  float inverse;   ///< 1/depth: continued to where the way began.
  float weight;    ///< Of its colour.
  bool is_barred;  ///< A silhouette was passed on the way.
  int direction = 0;
  float sides = 0;      ///< How far the colours beside it are from its own, squared.
  float coherence = 0;  ///< How much more they change across the way than along it.
};

/// A straight way over the picture: place after t steps of a pixel.
struct Way {
  Place start;
  float x, y;

  /// What t steps add up to, in whole pixels.
  Place steps(int t) const {
    const auto rounded = [&](float d) {
      return static_cast<int>(std::nearbyint(static_cast<float>(t) * d));
    };
    return {rounded(x), rounded(y)};
  }
  Place after(int t) const { return start + steps(t); }
};

/// NaN counts as the brightest.
inline float brightness(const Colour& c) {
  const float sum = std::fabs(c[0] + c[1] + c[2]);
  return std::isnan(sum) ? std::numeric_limits<float>::infinity() : sum;
}

/// Without alpha.
inline float sum_of_squares(const Colour& c) { return c[0] * c[0] + c[1] * c[1] + c[2] * c[2]; }

inline float squared_distance(Colour a, const Colour& b) {
  add(a, -1, b);
  return sum_of_squares(a);
}

class Filler {
 public:
  Filler(const Frame& f, const Words& marks, int directions)
      : frame_(f),
        inverse_(f.inverse.host()),
        channels_(f.channels),
        marks_(marks.host()),
        directions_(directions) {
    farthest_ = -DEFRAY_TAME_QUANTA;
    for (std::size_t i = 0; i < f.pixels(); ++i) farthest_ = std::max(farthest_, frame_.coc(i));
  }

  /// What lies behind the surface in front at a place, in each direction.
  std::vector<Found> look_behind(Place at, int own) const {
    std::vector<Found> all;
    for (int i = 0; i < directions_; ++i) {
      const double angle = i * 2 * std::numbers::pi / directions_;
      const Way way{at, static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle))};
      if (const auto found = look_along(way, own)) {
        all.push_back(looked_further(way, *found));
        all.back().direction = i;
      }
    }
    return all;
  }

  /// Signed CoC and 1/depth of the surface in front: of a mixed pixel, the nearest around it.
  std::pair<int, float> in_front(Place at) const {
    const std::size_t pixel = frame_.index(at);
    int coc = frame_.coc(pixel);
    float inverse = inverse_[pixel];
    if (!is_mixed(pixel)) return {coc, inverse};
    for_each_around(at, 1, [&](Place q) {
      coc = std::min(coc, frame_.coc(q));
      inverse = std::max(inverse, inverse_[frame_.index(q)]);
    });
    return {coc, inverse};
  }

 private:
  /// How far the lens sees past the edge of a surface in front of one this much farther.
  static int reach(int step) { return step / 256 + 2; }

  /// From how much farther on a surface shows behind one of the CoC `own`.
  static int least_rise(int own) {
    return std::max(DEFRAY_JUMP_QUANTA, std::abs(own) / DEFRAY_FILL_BLUR_TO_RISE);
  }

  std::optional<Found> look_along(const Way& way, int own) const {
    int before = own;
    for (int t = 1, step = 1; t <= reach(farthest_ - own); t += step) {
      const Place at = way.after(t);
      if (!frame_.contains(at)) return std::nullopt;
      const int coc = frame_.coc(at);
      const bool is_jump = coc - before > DEFRAY_JUMP_QUANTA * step;
      if (is_jump && coc - own > least_rise(own) && t <= reach(coc - own) &&
          passes_mixed(way, t - step, t)) {
        for (int i = t; i <= t + DEFRAY_FILL_MIXED; ++i) {
          const Place further = way.after(i);
          if (!frame_.contains(further)) return std::nullopt;
          const bool is_pure = !is_mixed(frame_.index(further));
          if (is_pure && frame_.coc(further) - own > least_rise(own)) {
            return continued(way, i, own);
          }
        }
      }
      before = coc;
      step = 1 + t / 16;  // far away less closely
    }
    return std::nullopt;
  }

  bool is_mixed(std::size_t pixel) const { return marks_[pixel] & DEFRAY_MIXED; }

  bool passes_silhouette(const Way& way, int last) const {
    while (last > 0 && !(marks_[frame_.index(way.after(last))] & DEFRAY_SILHOUETTE)) --last;
    return last > 0;
  }

  /// Without a mixed pixel what rises there is a surface that slants.
  bool passes_mixed(const Way& way, int first, int last) const {
    while (last >= first && !is_mixed(frame_.index(way.after(last)))) --last;
    return last >= first;
  }

  /// The surface after t steps, continued back to the start, no further than half the step in CoC.
  Found continued(const Way& way, int t, int own) const {
    const Place back = way.steps(t), on = way.steps(DEFRAY_FILL_LOOK_PX),
                beyond = way.start + back + on;
    const std::size_t q = frame_.index(way.start + back);
    const int coc = frame_.coc(q);
    const auto met = static_cast<float>(coc);
    Found found{q, static_cast<float>(t), met, met, inverse_[q], 0, passes_silhouette(way, t)};
    if (!frame_.contains(beyond)) return found;
    const std::size_t b = frame_.index(beyond);
    const auto slant = static_cast<float>(coc - frame_.coc(b));  // over DEFRAY_FILL_LOOK_PX
    if (is_mixed(b) || std::fabs(slant) > 4 * DEFRAY_JUMP_QUANTA) return found;
    const float most = 0.5f * static_cast<float>(coc - own);
    const float steps = static_cast<float>(back.x * on.x + back.y * on.y) /
                        static_cast<float>(on.x * on.x + on.y * on.y);
    const float change = slant * steps;
    const float kept = std::clamp(change, -most, most);
    const float share = change != 0 ? kept / change : 0;
    found.coc += kept;
    const float inverse = found.inverse + (inverse_[q] - inverse_[b]) * steps * share;
    found.inverse = inverse > 0 ? inverse : 0;
    return found;
  }

  /// With its colour's weight, from pixels further on; a small highlight that does not lie at
  /// the very edge gives its place to the brightest of them.
  Found looked_further(const Way& way, Found found) const {
    const int coc = frame_.coc(found.source), t = static_cast<int>(found.distance);
    const Colour colour = colour_at(channels_, found.source);
    float change = 0, size = sum_of_squares(colour), brightest = -1;
    std::size_t source = found.source;
    found.weight = 1 / (found.distance * found.distance);
    for (int i = 1; i <= DEFRAY_FILL_LOOKS; ++i) {
      const Place further = way.after(t + DEFRAY_FILL_LOOK_PX * i);
      if (!frame_.contains(further)) break;
      const std::size_t q = frame_.index(further);
      if (!is_same_surface(q, coc)) continue;
      const Colour c = colour_at(channels_, q);
      change += squared_distance(c, colour);
      size += sum_of_squares(c);
      if (!(brightness(c) > brightest)) continue;
      brightest = brightness(c);
      source = q;
    }
    if (brightest < 0) return found;
    if (std::isfinite(change) && std::isfinite(size)) {
      const float share = change > 0 ? std::fmin(change / size, 8.0f) : 0;
      found.weight /= 0.1f + share;
      const float sides = change_across(way, t, colour, coc);
      if (std::isfinite(sides) && sides > 0) {
        found.sides = sides;
        found.coherence = std::fmin(sides / (change + 0.1f * size), 30.0f);
      }
    }
    if (found.distance > 4 && brightness(colour) > 3 * brightest) found.source = source;
    return found;
  }

  bool is_same_surface(std::size_t pixel, int coc) const {
    return !is_mixed(pixel) && std::abs(frame_.coc(pixel) - coc) <= 4 * DEFRAY_JUMP_QUANTA;
  }

  /// Of the colour after t steps, and those on both sides of the way a little further on.
  float change_across(const Way& way, int t, const Colour& colour, int coc) const {
    float sum = 0;
    for (const int side : {-DEFRAY_FILL_SIDE_PX, DEFRAY_FILL_SIDE_PX}) {
      const Way across{way.after(t + DEFRAY_FILL_SIDES_AT_PX), -way.y, way.x};
      const Place at = across.after(side);
      if (!frame_.contains(at) || !is_same_surface(frame_.index(at), coc)) continue;
      sum += squared_distance(colour_at(channels_, frame_.index(at)), colour);
    }
    return sum;
  }

  CocFrame frame_;
  std::span<const float> inverse_;
  const Planes& channels_;
  std::span<const std::uint32_t> marks_;
  int directions_;
  std::int32_t farthest_;
};

}  // namespace defray::reference
