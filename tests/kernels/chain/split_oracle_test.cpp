// `split` a second time, on random frames: the twin goes its kernel's way, this goes by what the
// stage is for. Shares are sought, not computed.
#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "stages_support.h"

namespace defray::test::split_oracle_test {
namespace {

using Colour = std::array<double, 4>;

double distance2(const Colour& a, const Colour& b) {
  double sum = 0;
  for (std::size_t c = 0; c < 4; ++c) sum += (a[c] - b[c]) * (a[c] - b[c]);
  return sum;
}

Colour mixture(double share, const Colour& front, const Colour& behind) {
  Colour c;
  for (std::size_t i = 0; i < 4; ++i) c[i] = share * front[i] + (1 - share) * behind[i];
  return c;
}

Colour colour_of(const Planes& channels, std::size_t i) {
  return {channels[0][i], channels[1][i], channels[2][i], channels[3][i]};
}

/// A wall, and near rectangles on it whose outlines cover their pixels in part; depth sees either.
Canvas random_canvas(std::uint32_t seed) {
  Canvas f(46, 34);
  Random random(5, 6, seed);
  f.each([&](int x, int y) {
    Random noise(x, y, seed + 100);
    f.paint(x, y, static_cast<float>(0.2 + 0.05 * noise.next()), 0.3f,
            static_cast<float>(1.5 + 0.2 * noise.next()));
  });
  for (int i = 0; i < 3; ++i) {
    const int x0 = 3 + 14 * i + static_cast<int>(3 * random.next());
    const int y0 = 4 + static_cast<int>(9 * random.next());
    const int x1 = x0 + 6 + static_cast<int>(3 * random.next());
    const int y1 = y0 + 8 + static_cast<int>(9 * random.next());
    const auto coc = static_cast<std::int32_t>(-2000 * random.next());
    const Colour front{0.5 + random.next(), random.next(), 0.2 * random.next(), 1};
    for (int y = y0; y < y1; ++y) {
      for (int x = x0; x < x1; ++x) {
        const bool is_edge = x == x0 || y == y0 || x == x1 - 1 || y == y1 - 1;
        const double share = is_edge ? random.next() : 1;
        const std::size_t at = f.at(x, y);
        const Colour c = mixture(share, front, colour_of(f.view().channels, at));
        f.paint(x, y, static_cast<float>(c[0]), static_cast<float>(c[1]), static_cast<float>(c[2]));
        if (share < 0.2 || (is_edge && random.next() < 0.3)) continue;  // depth sees the wall
        f.coc[at] = coc;
        f.inverse[at] = 0.5f;
      }
    }
  }
  return f;
}

/// Pure pixels of one surface around a mixed pixel, by 1 / distance^4.
struct Pure {
  Colour mean{}, nearest{};
  double weights = 0, variance = 0;
};

template <typename IsOfIt>
Pure pure_around(const Canvas& f, const Words& mixed, int x, int y, const IsOfIt& is_of_it) {
  Pure pure;
  double largest = 0;
  std::vector<std::pair<double, Colour>> all;
  for (int j = -3; j <= 3; ++j) {
    for (int i = -3; i <= 3; ++i) {
      const std::size_t at =
          f.at(std::clamp(x + i, 0, f.width - 1), std::clamp(y + j, 0, f.height - 1));
      if (mixed[at] || !is_of_it(f.coc[at])) continue;
      const double weight = std::pow(std::hypot(i, j), -4);
      const Colour c = colour_of(f.view().channels, at);
      for (std::size_t k = 0; k < 4; ++k) pure.mean[k] += weight * c[k];
      if (weight > largest) pure.nearest = c;
      largest = std::max(largest, weight);
      pure.weights += weight;
      all.emplace_back(weight, c);
    }
  }
  for (double& v : pure.mean) v /= pure.weights;
  for (const auto& [weight, c] : all) {
    pure.variance += weight * distance2(c, pure.mean) / pure.weights;
  }
  return pure;
}

/// Of a mixed pixel.
struct Around {
  int nearest = 1 << 30, farthest = -(1 << 30);
  bool saw_front;
  Pure front, seen;  ///< Of the surface that the depth sample saw; in focus, of what lies beyond.

  bool is_in_focus() const { return saw_front && std::abs(nearest) < 256; }
};

Around around(const Canvas& f, const Words& mixed, int x, int y) {
  Around a;
  for (int j = -1; j <= 1; ++j) {
    for (int i = -1; i <= 1; ++i) {
      const int coc =
          f.coc[f.at(std::clamp(x + i, 0, f.width - 1), std::clamp(y + j, 0, f.height - 1))];
      a.nearest = std::min(a.nearest, coc);
      a.farthest = std::max(a.farthest, coc);
    }
  }
  const int middle = a.nearest + (a.farthest - a.nearest) / 2, own = f.coc[f.at(x, y)];
  a.saw_front = own < middle;
  a.front = pure_around(f, mixed, x, y, [&](int coc) { return coc < middle; });
  a.seen = pure_around(f, mixed, x, y,
                       [&](int coc) { return std::abs(coc - own) <= DEFRAY_JUMP_QUANTA; });
  return a;
}

/// Where a parabola over 0...1 is lowest, sought.
template <typename Cost>
double lowest(const Cost& cost) {
  double low = 0, high = 1;
  for (int i = 0; i < 60; ++i) {
    const double third = (high - low) / 3;
    (cost(low + third) < cost(high - third) ? high : low) +=
        cost(low + third) < cost(high - third) ? -third : third;
  }
  return (low + high) / 2;
}

/// Nearest to the pixel's colour, drawn to what is likely as the colours are alike, and the less
/// taken apart the more of the pixel both leave unexplained.
double sought_share(const Colour& c, const Around& a, const Colour& behind) {
  const Colour& front = a.front.mean;
  const double share = lowest([&](double s) { return distance2(mixture(s, front, behind), c); });
  const double contrast = distance2(front, behind);
  const double variance =
      a.front.variance + (!a.saw_front && a.seen.weights > 0 ? a.seen.variance : 0);
  const double sizes = distance2(front, {}) + distance2(behind, {});
  const double unsure = std::min(1e-3 * sizes + 2 * variance, 3e-2 * sizes);
  const double likely = a.saw_front ? 0.875 : 0.125;
  const double drawn = lowest([&](double s) {
    return contrast * (s - share) * (s - share) + unsure * (s - likely) * (s - likely);
  });
  const double left = distance2(mixture(share, front, behind), c);
  const double fit = 1 / (1 + left / (contrast + unsure));
  return a.saw_front ? 1 - (1 - drawn) * fit : drawn * fit;
}

/// The same in focus: drawn to 1 as the surfaces' colours vary, and as both leave C unexplained.
double sought_share_in_focus(const Colour& c, const Around& a, const Colour& behind) {
  const auto mixed = [&](double s) { return mixture(s, a.front.mean, behind); };
  const double share = lowest([&](double s) { return distance2(mixed(s), c); });
  const double variance = a.front.variance + (a.seen.weights > 0 ? a.seen.variance : 0);
  const double contrast = distance2(a.front.mean, behind);
  const double unsure = 4 * variance + 64 * distance2(mixed(share), c);
  return lowest(
      [&](double s) { return contrast * (s - share) * (s - share) + unsure * (s - 1) * (s - 1); });
}

/// What lies behind, of which the pixel is a mixture: what `fill` found or, where the depth sample
/// saw it and it comes twice as near, the nearest pure pixel of its surface, or their mean.
Colour sought_behind(const Colour& c, const Around& a, const Colour& made_up) {
  if (a.seen.weights == 0) return made_up;
  const auto misfit = [&](const Colour& behind) {
    const auto mixed = [&](double share) { return mixture(share, a.front.mean, behind); };
    return distance2(mixed(lowest([&](double share) { return distance2(mixed(share), c); })), c);
  };
  Colour best = made_up;
  for (const Colour& other : {a.seen.nearest, a.seen.mean}) {
    if (misfit(other) < 0.25 * misfit(best)) best = other;
  }
  return best;
}

/// Colours of the surface that a mixed pixel's depth saw: of pure pixels around, what `fill` found,
/// and the pixel's own.
std::vector<Colour> known_behind(const Canvas& f, const Words& mixed, const Frame& filled, int x,
                                 int y) {
  const std::size_t own = f.at(x, y);
  std::vector<Colour> known{colour_of(filled.channels, own), colour_of(f.view().channels, own)};
  for (int j = std::max(y - 3, 0); j <= std::min(y + 3, f.height - 1); ++j) {
    for (int i = std::max(x - 3, 0); i <= std::min(x + 3, f.width - 1); ++i) {
      const std::size_t at = f.at(i, j);
      if (mixed[at] || std::abs(f.coc[at] - f.coc[own]) > DEFRAY_JUMP_QUANTA) continue;
      known.push_back(colour_of(f.view().channels, at));
    }
  }
  return known;
}

/// What became of mixed pixels.
struct Counts {
  int fronts = 0, behinds = 0, in_focus = 0, wholes = 0;
};

void expect_share(const Canvas& f, const Words& mixed, const Frame& filled, const Parted& s, int x,
                  int y, Counts& counts) {
  const std::size_t i = f.at(x, y);
  Around a = around(f, mixed, x, y);
  const bool saw_front = a.saw_front;
  if (a.is_in_focus()) {
    a.seen = pure_around(f, mixed, x, y, [&](int coc) {
      return std::abs(coc - filled.coc_quanta[i]) <= DEFRAY_JUMP_QUANTA;
    });
  }
  // Two surfaces, both in pure pixels.
  if (a.front.weights == 0 ||
      (!saw_front && std::abs(filled.coc_quanta[i] - f.coc[i]) > DEFRAY_JUMP_QUANTA))
    return;
  const Colour c = colour_of(f.view().channels, i);
  Colour made_up = colour_of(filled.channels, i);
  if (!saw_front || a.is_in_focus()) made_up = sought_behind(c, a, made_up);
  const double share =
      a.is_in_focus() ? sought_share_in_focus(c, a, made_up) : sought_share(c, a, made_up);
  if (std::fabs(share - 0.03) < 1e-3 || std::fabs(share - 0.97) < 1e-3) return;
  const bool is_sharp = a.is_in_focus() && std::abs(filled.coc_quanta[i]) < 512;
  const bool is_whole = saw_front ? share > 0.97 || is_sharp : share < 0.03;
  const double kept = saw_front ? std::max(share, 0.25) : std::min(share, 0.75);
  const double coverage = s.front.coverage[i] / 65536.0;
  SCOPED_TRACE(testing::Message() << x << " " << y << ", " << share);
  EXPECT_NEAR(coverage, is_whole ? 1 : kept, 1e-4);
  EXPECT_EQ(is_fragment(s.behind.depth[i]), !is_whole || saw_front);
  const Colour front = colour_of(s.front.channels, i);
  if (is_whole) {
    ++counts.wholes;
    EXPECT_LT(distance2(front, c), 1e-12);
    return;
  }
  (a.is_in_focus() ? counts.in_focus : saw_front ? counts.fronts : counts.behinds) += 1;
  // What is left for the surface that was seen, once the other has its part; never below 0 nor,
  // behind, beyond the colours that are known of it.
  Colour rest = mixture(1 / (saw_front ? coverage : 1 - coverage), c, saw_front ? made_up : front);
  for (double& v : rest) v = std::max(v, 0.0);
  if (!saw_front) {
    const std::vector<Colour> known = known_behind(f, mixed, filled, x, y);
    for (std::size_t k = 0; k < rest.size(); ++k) {
      const auto by_channel = [&](const Colour& one, const Colour& two) { return one[k] < two[k]; };
      const auto [low, high] = std::minmax_element(known.begin(), known.end(), by_channel);
      rest[k] = std::clamp(rest[k], (*low)[k], (*high)[k]);
    }
  }
  EXPECT_LT(distance2(saw_front ? front : colour_of(s.behind.channels, i), rest), 1e-9);
}

TEST(Split, SharesAreThoseASearchFinds) {
  Counts counts;
  for (std::uint32_t seed = 0; seed < 8; ++seed) {
    Canvas f = random_canvas(seed);
    const Words mixed = f.mixed();
    const Frame filled = f.filled();
    const Parted surfaces(device().split(f.view(), mixed, filled));
    f.each([&](int x, int y) {
      const bool is_split = mixed[f.at(x, y)] && filled.inverse[f.at(x, y)] >= 0;
      if (is_split) expect_share(f, mixed, filled, surfaces, x, y, counts);
    });
  }
  EXPECT_GT(counts.fronts, 50);
  EXPECT_GT(counts.behinds, 50);
  EXPECT_GT(counts.in_focus, 20);
  EXPECT_GT(counts.wholes, 20);
}

}  // namespace
}  // namespace defray::test::split_oracle_test
