// Twin of kernels/chain/split.cl.
#include <optional>

#include "reference/split_nearby.h"

namespace defray::reference {
namespace {

/// C beside what F and B can make: the share of F that comes nearest, and what is left then.
struct Fit {
  Fit(const Colour& c, const Colour& f, const Colour& b) {
    const Colour all = minus(f, b);
    along = inner_product(minus(c, b), all);
    length2 = inner_product(all, all);
    share = length2 > 0 ? std::clamp(along / length2, 0.0f, 1.0f) : 0;
    Colour left = minus(c, b);
    for (std::size_t i = 0; i < 4; ++i) left[i] -= share * all[i];
    misfit2 = inner_product(left, left);
  }
  float along, length2, share, misfit2;
};

/// Share a of the front F that makes a F + (1 - a) B most like C, drawn towards what is likely
/// where F and B are as alike as their own colours are.
float coverage_of(const Colour& c, const Colour& f, const Colour& b, float variance,
                  bool saw_front) {
  const auto [along, length2, share, misfit2] = Fit(c, f, b);
  Colour sizes;
  for (std::size_t i = 0; i < 4; ++i) sizes[i] = f[i] * f[i] + b[i] * b[i];
  const float size2 = sizes[0] + sizes[1] + sizes[2] + sizes[3];
  const float unsure = std::fmin(1e-3f * size2 + 2 * variance, 3e-2f * size2);
  const float likely = saw_front ? 0.875f : 0.125f;
  if (!std::isfinite(along) || !std::isfinite(length2 + unsure)) return saw_front ? 1 : 0;
  if (length2 + unsure == 0) return likely;
  const float mean = (share * length2 + likely * unsure) / (length2 + unsure);
  const float fit = (length2 + unsure) / (length2 + unsure + misfit2);
  return saw_front ? 1 - (1 - mean) * fit : mean * fit;
}

/// The same of what is in focus: less the more variances and what stays unexplained amount to.
float coverage_in_focus(const Colour& c, const Colour& f, const Colour& b, float variance) {
  const auto [along, length2, share, misfit2] = Fit(c, f, b);
  const float all2 = length2 + (4 * variance + 64 * misfit2);
  if (!std::isfinite(along) || !std::isfinite(all2) || all2 == 0) return 1;
  return 1 - (1 - share) * length2 / all2;
}

/// `best` behind F, unless another explains C twice as well.
Colour best_behind(const Colour& c, const Colour& f, Colour best,
                   std::initializer_list<Colour> others) {
  for (const Colour& other : others) {
    if (Fit(c, f, other).misfit2 < 0.25f * Fit(c, f, best).misfit2) best = other;
  }
  return best;
}

/// What is in front: the nearest surface, unless the next one around, before the farthest, explains
/// C better.
Front best_front(const Splitter& splitter, Place at, const Colour& c, const Colour& behind) {
  const std::set<int> radii = splitter.radii(at);
  const int nearest = *radii.begin(), farthest = *radii.rbegin();
  const Front front = splitter.front(at, nearest, farthest, behind);
  const auto second = radii.upper_bound(nearest + DEFRAY_JUMP_QUANTA);
  if (second == radii.end() || *second >= farthest - DEFRAY_JUMP_QUANTA) return front;
  const Front other = splitter.front(at, *second, farthest, behind);
  if (!front.surface || !other.surface) return front;
  const Colour &f1 = front.surface->colour, &f2 = other.surface->colour, d = minus(f2, behind);
  // Not where it is a mixture of the nearest and B, as anti-aliased depth makes it.
  if (!(Fit(f2, f1, behind).misfit2 > (1 - 0.98f) * inner_product(d, d))) return front;
  return Fit(c, f2, behind).misfit2 < Fit(c, f1, behind).misfit2 ? other : front;
}

/// C without the other surface's part, never below 0 where C is not.
Colour rest_of(const Colour& c, const Colour& other, float others_share) {
  Colour rest;
  for (std::size_t i = 0; i < 4; ++i) {
    rest[i] = (c[i] - others_share * other[i]) / (1 - others_share);
    const float least = c[i] < 0 ? c[i] : 0;
    if (rest[i] < least) rest[i] = least;
  }
  return rest;
}

/// Within C, B and the colours that were seen of B's surface.
Colour plausible(const std::optional<Nearby>& seen, const Colour& b, const Colour& c, Colour rest) {
  Hull hull;
  hull.add(c);
  hull.add(b);
  if (seen) hull.add(seen->hull.low), hull.add(seen->hull.high);
  for (std::size_t i = 0; i < 4; ++i) {
    if (rest[i] < hull.low[i]) rest[i] = hull.low[i];
    if (rest[i] > hull.high[i]) rest[i] = hull.high[i];
  }
  return rest;
}

/// Coverages in 2^-16; the colours are made for the stored share.
std::uint32_t stored(float share) {
  return static_cast<std::uint32_t>(std::nearbyint(share * DEFRAY_WHOLE));
}
float share_of(std::uint32_t coverage) { return static_cast<float>(coverage) / DEFRAY_WHOLE; }

/// One surface of each pixel, to work on.
struct Layer {
  std::vector<std::int32_t> coc_quanta;
  Plane inverse;
  std::vector<Plane> channels;
  std::vector<std::uint32_t> coverage;
  Planes before;  ///< Its colours as they came.

  Layer(const Frame& f, std::uint32_t covers)
      : coc_quanta(copy_of(f.coc_quanta)),
        inverse(copy_of(f.inverse)),
        channels(planes_of(f.channels)),
        coverage(f.pixels(), covers),
        before(f.channels) {}
};

/// Both as layers: [height][2][width].
Frame layered(Frame f, const Layer& front, const Layer& behind) {
  f.layers = 2;
  std::vector<std::int32_t> coc(f.surfaces());
  Plane depth(f.surfaces());
  std::vector<std::uint32_t> coverage(f.surfaces());
  std::vector<Plane> channels(front.channels.size(), Plane(f.surfaces()));
  for (const int layer : {0, 1}) {
    const Layer& from = layer == 0 ? front : behind;
    for (std::size_t pixel = 0; pixel < f.pixels(); ++pixel) {
      const std::size_t to = f.front_of(pixel) + size(layer) * size(f.width);
      const float inverse = from.inverse[pixel];
      coc[to] = from.coc_quanta[pixel];
      depth[to] = inverse < 0 ? no_fragment() : 1 / std::fabs(inverse);  // inf before nothing
      if (!(inverse < 0)) {
        coverage[to] = from.coverage[pixel] | (f.is_in_margin(pixel) ? DEFRAY_SYNTHESISED : 0);
      }
      for (std::size_t c = 0; c < channels.size(); ++c) {
        channels[c][to] = from.channels[c][pixel];
      }
    }
  }
  f.coc_quanta = std::move(coc);
  f.depth = std::move(depth);
  f.coverage = std::move(coverage);
  f.channels = channels;
  return f;
}

}  // namespace

Frame TwinBackend::split(const Frame& f, const Words& mixed_pixels, const Frame& frame_behind,
                         Frame) {
  Layer front(f, DEFRAY_WHOLE), behind(frame_behind, DEFRAY_WHOLE | DEFRAY_SYNTHESISED);
  const Splitter splitter(f, mixed_pixels);
  const auto mixed = mixed_pixels.host();
  const CocFrame frame(f);
  frame.for_each_place([&](Place at) {
    const std::size_t pixel = frame.index(at);
    if (!mixed[pixel] || behind.inverse[pixel] < 0) return;
    const Colour c = colour_at(f.channels, pixel);
    Colour b = colour_at(behind.before, pixel);
    auto [found, nearest, middle, is_thin] = best_front(splitter, at, c, b);
    bool saw_front = frame.coc(at) < middle;
    std::size_t saw = pixel;  // whose surface
    std::optional<std::size_t> lamp;
    if (saw_front) {
      lamp =
          is_thin ? splitter.lamp_of(at, middle) : splitter.lamp_of(at, middle, found->colour, b);
    }
    const int own = frame.coc(at);
    auto seen = splitter.pure(at, own - DEFRAY_JUMP_QUANTA, own + DEFRAY_JUMP_QUANTA);
    const bool is_third = std::abs(tame(behind.coc_quanta[pixel]) - own) > DEFRAY_JUMP_QUANTA;
    if (lamp) {
      saw_front = false;
      saw = *lamp;
      front.coc_quanta[pixel] = f.coc_quanta[saw];
      front.inverse[pixel] = f.inverse[saw];
      b = colour_at(f.channels, saw);
      if (found) found->source = pixel;
      seen.reset();
    }
    if (!saw_front && is_third && seen) b = seen->colour;
    if (!saw_front && !is_third && seen && found) {
      b = best_behind(c, found->colour, b, {colour_at(f.channels, seen->source), seen->colour});
    }
    const float variance =
        (found ? found->variance : 0) + (!saw_front && seen ? seen->variance : 0);
    float share = saw_front ? 1 : 0;
    if (found) share = coverage_of(c, found->colour, b, variance, saw_front);
    if (saw_front) {
      if (!is_thin && std::abs(nearest) < DEFRAY_SMALL_QUANTA) {
        const int far = tame(behind.coc_quanta[pixel]);
        if (std::abs(far) < 512) return;
        const auto beyond = splitter.pure(at, far - DEFRAY_JUMP_QUANTA, far + DEFRAY_JUMP_QUANTA);
        if (beyond) {
          const Colour closest = colour_at(f.channels, beyond->source);
          b = best_behind(c, found->colour, b, {closest, beyond->colour});
        }
        share = coverage_in_focus(c, found->colour, b,
                                  found->variance + (beyond ? beyond->variance : 0));
      }
      if (share > 1 - 0.03f) return;
      front.coverage[pixel] = stored(std::max(share, 0.25f));
      set_colour(front.channels, pixel, rest_of(c, b, 1 - share_of(front.coverage[pixel])));
    } else if (share < 0.03f) {
      behind.inverse[pixel] = -1;
    } else {
      front.coverage[pixel] = stored(std::min(share, 0.75f));
      front.coc_quanta[pixel] = f.coc_quanta[found->source];
      front.inverse[pixel] = f.inverse[found->source];
      set_colour(front.channels, pixel, found->colour);
      behind.coc_quanta[pixel] = f.coc_quanta[saw];
      behind.inverse[pixel] = f.inverse[saw];
      behind.coverage[pixel] = DEFRAY_WHOLE;
      set_colour(behind.channels, pixel,
                 plausible(seen, b, c, rest_of(c, found->colour, share_of(front.coverage[pixel]))));
    }
  });
  return layered(f.without_planes(), front, behind);
}

}  // namespace defray::reference
