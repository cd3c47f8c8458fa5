#pragma once
// Surfaces that the twin of `split` finds around a pixel (kernels/chain/split_nearby.clh).
#include <cmath>
#include <limits>
#include <optional>
#include <set>

#include "reference/stage_frame.h"

namespace defray::reference {

/// Of colours, channel by channel; one that is not a number does not count.
struct Hull {
  Colour low, high;

  Hull() {
    low.fill(std::numeric_limits<float>::infinity());
    high.fill(-std::numeric_limits<float>::infinity());
  }

  void add(const Colour& colour) {
    for (std::size_t i = 0; i < 4; ++i) {
      if (colour[i] < low[i]) low[i] = colour[i];
      if (colour[i] > high[i]) high[i] = colour[i];
    }
  }
};

/// A surface, from the pixels around.
struct Nearby {
  Colour colour;
  std::size_t source;  ///< Whose depth it has.
  Hull hull;           ///< Of the colours that it is the mean of, and
  float variance;      ///< theirs, all channels together.
};

/// What is in front in a mixed pixel.
struct Front {
  std::optional<Nearby> surface;
  int nearest, middle;  ///< Its CoC; from `middle` on surfaces lie behind it.
  bool is_thin;         ///< No pixel of it is pure.
};

/// a . b, added in channel order.
inline float inner_product(const Colour& a, const Colour& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
}

inline Colour minus(Colour a, const Colour& b) {
  for (std::size_t c = 0; c < 4; ++c) a[c] -= b[c];
  return a;
}

inline Colour times(Colour a, const Colour& b) {
  for (std::size_t c = 0; c < 4; ++c) a[c] *= b[c];
  return a;
}

class Splitter {
 public:
  Splitter(const Frame& f, const Words& mixed)
      : frame_(f), channels_(f.channels), mixed_(mixed.host()) {}

  /// CoC of the pixels around, from the nearest on, each once.
  std::set<int> radii(Place at) const {
    std::set<int> all;
    for_each_around(at, 1, [&](Place q) { all.insert(frame_.coc(q)); });
    return all;
  }

  /// The surface with the CoC `nearest`, before that with the CoC `farthest`.
  Front front(Place at, int nearest, int farthest, const Colour& behind) const {
    const int middle = nearest + (farthest - nearest) / 2;
    const int least = nearest - DEFRAY_JUMP_QUANTA;
    const int most = std::min(middle - 1, nearest + DEFRAY_JUMP_QUANTA);
    if (const auto found = pure(at, least, most)) return {found, nearest, middle, false};
    return {thin_front(at, {least, most}, middle, behind), nearest, middle, true};
  }

  /// Pure pixels with a CoC from `low` to `high`, weighed by 1 / distance^4; the nearest lends its
  /// depth.
  std::optional<Nearby> pure(Place at, int low, int high) const {
    Nearby found{};
    Colour squares{};
    float weights = 0, largest = 0;
    for_each_around(at, 3, [&](Place place) {
      const std::size_t q = frame_.index(place);
      if (mixed_[q] || frame_.coc(q) < low || frame_.coc(q) > high) return;
      const Place d = place - at;
      const int distance2 = d.x * d.x + d.y * d.y;
      const float weight = 1.0f / static_cast<float>(distance2 * distance2);
      const Colour colour = colour_at(channels_, q);
      add(found.colour, weight, colour);
      add(squares, weight, times(colour, colour));
      found.hull.add(colour);
      weights += weight;
      if (weight > largest) found.source = q;
      largest = std::max(largest, weight);
    });
    if (weights == 0) return std::nullopt;
    found.colour = divided(found.colour, weights);
    const Colour mean2 = times(found.colour, found.colour);
    const Colour variances = minus(divided(squares, weights), mean2);
    const float sum = variances[0] + variances[1] + variances[2] + variances[3];
    found.variance = std::fmax(sum, 0.0f);
    return found;
  }

  /// Of what is too thin for pure pixels, with such a CoC, the one least like the surface behind;
  /// none that a lamp, from `middle` on, lights. Where `at` saw it, not lit: one that goes on
  /// as `at` does.
  std::optional<Nearby> thin_front(Place at, std::pair<int, int> range, int middle,
                                   const Colour& behind) const {
    std::optional<Nearby> front;
    float farthest = -1;
    const float limit = brightest_front(at, middle);
    const std::size_t pixel = frame_.index(at);
    const bool is_part = frame_.coc(at) < middle && !(bright(pixel) > limit);
    const Colour own = minus(colour_at(channels_, pixel), behind);
    for_each_around(at, is_part ? DEFRAY_SPLIT_THIN_PX : 3, [&](Place place) {
      const std::size_t q = frame_.index(place);
      if (frame_.coc(q) < range.first || frame_.coc(q) > range.second) return;
      if (lamp_of(place, middle, limit)) return;
      const Colour colour = colour_at(channels_, q), d = minus(colour, behind);
      const float far = inner_product(d, d), along = inner_product(d, own);
      if (!(far > farthest)) return;
      const bool goes_on = along > 0 && along * along > 0.98f * far * inner_product(own, own);
      if (is_part && !goes_on) return;
      farthest = far;
      front = {colour, q, {}, 0};
    });
    return front;
  }

  /// Of a pixel in front: the brightest farther one beside it, where a lamp shines beside it.
  std::optional<std::size_t> lamp_of(Place at, int middle) const {
    return lamp_of(at, middle, brightest_front(at, middle));
  }

  /// The same before a surface whose colours are known, where it is far brighter than both.
  std::optional<std::size_t> lamp_of(Place at, int middle, const Colour& front,
                                     const Colour& behind) const {
    return lamp_of(at, middle, 7 * std::fmax(brightness(front), brightness(behind)));
  }

 private:
  static float brightness(const Colour& c) {
    return std::fabs(c[0]) + std::fabs(c[1]) + std::fabs(c[2]);
  }
  float bright(std::size_t q) const { return brightness(colour_at(channels_, q)); }

  /// What is in front is at most so much brighter than the darkest behind it if something farther
  /// is brighter still: a lamp.
  float brightest_front(Place at, int middle) const {
    float darkest = std::numeric_limits<float>::infinity(), brightest = 0, front = 0;
    for_each_around(at, 3, [&](Place place) {
      const std::size_t q = frame_.index(place);
      if (frame_.coc(q) < middle) {
        front = std::fmax(front, bright(q));
      } else {
        darkest = std::fmin(darkest, bright(q));
        brightest = std::fmax(brightest, bright(q));
      }
    });
    return brightest > front ? 7 * darkest : std::numeric_limits<float>::infinity();
  }

  std::optional<std::size_t> lamp_of(Place at, int middle, float limit) const {
    const float own = bright(frame_.index(at));
    std::optional<std::size_t> lamp;
    if (!(own > limit)) return lamp;
    float brightest = own / 2;
    for_each_around(at, 1, [&](Place place) {
      const std::size_t q = frame_.index(place);
      if (frame_.coc(q) < middle || !(bright(q) > brightest)) return;
      brightest = bright(q);
      lamp = q;
    });
    return lamp;
  }

  CocFrame frame_;
  const Planes& channels_;
  std::span<const std::uint32_t> mixed_;
};

}  // namespace defray::reference
