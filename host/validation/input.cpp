#include "validation/input.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/random.h"
#include "lens/coc.h"

namespace defray::validation {
namespace {

constexpr float infinite = std::numeric_limits<float>::infinity();

/// Depth, and CoC as a share of the largest.
struct Point {
  float depth;
  double share;
};

/// Depths from denormal to the largest float, the special ones, and those beside the focus.
float any_depth(double focus, Random& random) {
  constexpr std::array special{infinite, 1e10f, 65504.0f, 1e-6f, 1e-38f, 1e-45f, 3.4e38f, 1.0f};
  const double choice = random.next();
  if (choice < 0.1) return special[static_cast<std::size_t>(choice * 80)];
  if (choice < 0.3) return static_cast<float>(1 + 8 * random.next());
  if (choice < 0.5 && std::isfinite(focus)) {
    float z = static_cast<float>(focus);
    for (double steps = 8 * random.next() - 4; steps > 0; --steps) z = std::nextafter(z, infinite);
    return z;
  }
  return std::max(static_cast<float>(std::exp2(-149 + 276 * random.next())), 1e-45f);
}

Point point_at(const Case& c, int x, int y, Random& random) {
  const double across = (x + 0.5) / c.width;
  switch (c.pattern) {
    case Pattern::constant:
      return {2, 1};
    case Pattern::slanted:
      return {static_cast<float>(1 + 8 * across), 2 * across - 1};
    case Pattern::steps: {
      Random block(x / 11, y / 7, c.seed);
      const auto depth = static_cast<float>(1 + std::floor(8 * block.next()));
      return {depth, std::floor(9 * block.next()) / 4 - 1};
    }
    case Pattern::random:
      return {any_depth(c.focus, random), 2 * random.next() - 1};
    case Pattern::ties: {
      const auto depth = static_cast<float>(1 + std::floor(3 * random.next()));
      const double halves = 2 * c.coc_px * (2 * random.next() - 1);
      return {random.next() < 0.05 ? infinite : depth,
              c.coc_px > 0 ? std::trunc(halves) / (2 * c.coc_px) : 0};
    }
    case Pattern::converging: {
      const double order = (y + (x + 0.5) / c.width) / c.height;
      const double to_middle = c.seed % 2 == 0 ? c.width / 2 - x : c.height / 2 - y;
      return {static_cast<float>(9 - 8 * order), c.coc_px > 0 ? 2 * to_middle / c.coc_px : 0};
    }
    case Pattern::checker:
      return (x + y) % 2 == 0 ? Point{1, -1} : Point{5, 1};
    case Pattern::sparse: {
      const bool is_wide = random.next() < 1.0 / 512 || (x == c.width / 3 && y == c.height / 2);
      return is_wide ? Point{1, random.next() < 0.5 ? -1.0 : 1.0} : Point{3, 0};
    }
  }
  return {1, 0};
}

float colour(Colours colours, Random& random) {
  constexpr std::array extremes{0.0f,  -0.0f,  1e-45f, -1e-45f, 65504.0f,
                                1e30f, -1e30f, 1.0f,   0.18f,   std::numeric_limits<float>::max()};
  constexpr std::array nonfinite{infinite, -infinite, std::numeric_limits<float>::quiet_NaN()};
  const double choice = random.next();
  switch (colours) {
    case Colours::plain:
      break;
    case Colours::wild:
      return static_cast<float>(std::exp2(12 * random.next() - 6) * (choice < 0.125 ? -1 : 1));
    case Colours::extreme:
      return extremes[static_cast<std::size_t>(choice * extremes.size())];
    case Colours::nonfinite:
      if (choice < 0.03) return nonfinite[static_cast<std::size_t>(choice * 100)];
  }
  return static_cast<float>(random.next());
}

/// f = 50 mm on 36 mm film; the aperture that makes the background's CoC as large as asked.
Lens lens_of(const Case& c) {
  Lens lens;
  lens.focus_distance_units = c.focus;
  const double distance = std::isinf(c.focus) ? 1 : c.focus;
  lens.aperture_diameter_mm = 1000 * 2 * c.coc_px * distance / pixel_focal_length(lens, c.width);
  return lens;
}

/// Shares of a pixel: mostly whole or even, some none at all.
std::uint32_t any_coverage(Random& random) {
  constexpr std::array shares{0u, 1u, 655u, 32768u, 65535u};
  const double choice = random.next();
  const std::uint32_t share =
      choice < 0.5 ? DEFRAY_WHOLE : shares[static_cast<std::size_t>((choice - 0.5) * 10)];
  return share | (random.next() < 0.5 ? DEFRAY_SYNTHESISED : 0);
}

/// Where a frame has pixels that are more than one whole surface: of every third seed's in few
/// places, else everywhere.
bool may_be_special(const Case& c, int x, int y) {
  return c.seed % 3 != 2 || Random(x / 9, y, c.seed).next() < 0.05;
}

/// Behind each pixel one of its neighbours along the row, further away, or nothing.
Frame make_fragments(const Case& c, const Input& in) {
  Frame f;
  f.width = c.width;
  f.height = c.height;
  f.layers = c.seed % 3 == 0 ? 1 : 2;
  std::vector<std::int32_t> coc;
  Plane depth;
  std::vector<std::uint32_t> coverage;
  std::vector<Plane> channels(in.channels.size());
  for (int y = 0; y < c.height; ++y) {
    for (int layer = 0; layer < f.layers; ++layer) {
      for (int x = 0; x < c.width; ++x) {
        Random random(x, y + layer * c.height, c.seed);
        const int from = layer == 0 ? x : static_cast<int>(random.next() * c.width);
        const std::size_t at = size(y) * size(c.width) + size(from);
        const bool is_special = may_be_special(c, x, y);
        const bool is_there = layer == 0 || (is_special && random.next() < 0.5);
        coc.push_back(in.coc_quanta[at]);
        depth.push_back(is_there ? in.depth[at] : no_fragment());
        if (f.layers > 1) coverage.push_back(is_special ? any_coverage(random) : DEFRAY_WHOLE);
        for (std::size_t k = 0; k < channels.size(); ++k) {
          channels[k].push_back(in.channels[k][at]);
        }
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

Input make_input(const Case& c) {
  Input in;
  in.lens = lens_of(c);
  in.channels.resize(static_cast<std::size_t>(c.channels));
  for (int y = 0; y < c.height; ++y) {
    for (int x = 0; x < c.width; ++x) {
      Random random(x, y, c.seed);
      const Point p = point_at(c, x, y, random);
      in.depth.push_back(p.depth);
      const double quanta = quanta_per_px * c.coc_px * std::clamp(p.share, -1.0, 1.0);
      in.coc_quanta.push_back(static_cast<std::int32_t>(std::lround(quanta)));
      for (Plane& plane : in.channels) plane.push_back(colour(c.colours, random));
    }
  }
  in.fragments = make_fragments(c, in);
  return in;
}

Frame frame_of(const Case& c, const Input& in) {
  Frame f;
  f.width = c.width;
  f.height = c.height;
  f.coc_quanta = Quanta::view(in.coc_quanta.data(), in.coc_quanta.size());
  f.depth = Values<float>::view(in.depth.data(), in.depth.size());
  f.channels = Planes::view(in.channels);
  return f;
}

}  // namespace defray::validation
