#pragma once
// A wall, and a bar in front of it that hides a part: for the tests of `patterns`.
#include <cmath>
#include <numbers>

#include "base/random.h"
#include "chain/patterns/patterns.h"
#include "support.h"

namespace defray::test {

/// Colours are linear and encoded at once: the
/// stage does not ask which curve lies between.
struct PatternScene {
  explicit PatternScene(Size s) : size(s), encoded(pixels()), coc(pixels()), behind_coc(pixels()) {
    is_behind.resize(pixels());
    inverse.assign(pixels(), 1);
    behind_inverse.assign(pixels(), 1);
    channels.assign(3, Plane(pixels()));
    behind.assign(3, Plane(pixels()));
    truth = behind;
  }

  std::size_t pixels() const {
    return static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height);
  }
  std::size_t at(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(size.width) +
           static_cast<std::size_t>(x);
  }

  /// The wall's colours everywhere; `hidden(x, y)` says where the bar is.
  template <typename Wall, typename Hidden>
  void paint(const Wall& wall, const Hidden& hidden) {
    for (int y = 0; y < size.height; ++y) {
      for (int x = 0; x < size.width; ++x) {
        const std::size_t i = at(x, y);
        is_behind[i] = hidden(x, y);
        encoded[i] = is_behind[i] ? 0 : DEFRAY_PATTERN_KNOWN;
        coc[i] = is_behind[i] ? -2560 : 512;
        behind_coc[i] = 512;
        for (std::size_t c = 0; c < 3; ++c) {
          const float v = is_behind[i] ? 0.9f : wall(x, y, static_cast<int>(c));
          channels[c][i] = v;
          behind[c][i] = is_behind[i] ? 0.5f : -7.0f;  // not to be touched
          const float clipped = std::clamp(v, 0.0f, 1.0f);
          encoded[i] |= static_cast<std::uint32_t>(std::lround(255 * clipped)) << (8 * c);
        }
      }
    }
  }

  Frame frame() const {
    Frame f{size.width, size.height, coc, {}, channels};
    f.inverse = inverse;
    return f;
  }
  Frame hidden() const {
    Frame f{size.width, size.height, behind_coc, {}, behind};
    f.inverse = behind_inverse;
    return f;
  }
  Words words() const {
    return patterns_pixels(encoded, channels, {is_behind.begin(), is_behind.end()});
  }

  std::vector<Plane> improved(const PatternSettings& settings = {}) const {
    return improved(device(), settings);
  }
  std::vector<Plane> improved(Backend& backend, const PatternSettings& settings = {}) const {
    Frame result = hidden();
    const auto shifts = find_shifts(backend, frame(), words(), settings);
    improve_by_patterns(backend, frame(), words(), shifts, settings, result);
    std::vector<Plane> planes;
    for (const auto& channel : result.channels) planes.emplace_back(channel.begin(), channel.end());
    return planes;
  }

  /// Root mean square distance to the wall, over what is hidden.
  template <typename Wall>
  double error(const std::vector<Plane>& planes, const Wall& wall) const {
    double sum = 0, count = 0;
    for (std::size_t i = 0; i < pixels(); ++i) {
      if (!is_behind[i]) continue;
      const int x = static_cast<int>(i) % size.width, y = static_cast<int>(i) / size.width;
      for (int c = 0; c < 3; ++c) {
        const double d = planes[static_cast<std::size_t>(c)][i] - wall(x, y, c);
        sum += d * d;
        ++count;
      }
    }
    return std::sqrt(sum / count);
  }

  Size size;
  std::vector<std::uint32_t> encoded;
  std::vector<std::int32_t> coc, behind_coc;
  std::vector<std::uint32_t> is_behind;
  std::vector<Plane> channels, behind, truth;
  Plane inverse, behind_inverse;
};

inline constexpr Size picture{200, 120};

/// Bricks: 24 px wide, 14 px high.
inline float bricks(int x, int y, int c) {
  const double u = 2 * std::numbers::pi * x / 24, v = 2 * std::numbers::pi * y / 14;
  return static_cast<float>(0.5 + 0.2 * std::sin(u + c) + 0.2 * std::sin(v + 2 * c));
}

inline float noise(int x, int y, int c) { return static_cast<float>(Random(x, y, 17 + c).next()); }

inline bool bar(int x, int) { return x >= 90 && x < 104; }

inline PatternScene scene_of(float (*wall)(int, int, int), Size size = picture) {
  PatternScene s(size);
  s.paint(wall, bar);
  return s;
}

}  // namespace defray::test
