// Colours beyond the frame, retold pixel by pixel on random frames: the mean of as much of the
// edge's surface as lies as far inside.
#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "chain/steps/border.h"
#include "support.h"

namespace defray::test::border_colours_test {
namespace {

/// Stripes of surfaces, their CoC a little rough; colours of which a few are no numbers.
Frame striped(int width, int height, int margin, int layers, std::uint32_t seed) {
  Frame f{width + 2 * margin, height + 2 * margin};
  f.margin = margin;
  f.layers = layers;
  std::vector<std::int32_t> coc(f.surfaces());
  std::vector<Plane> channels(3, Plane(f.surfaces()));
  for (std::size_t i = 0; i < f.surfaces(); ++i) {
    const int x = static_cast<int>(i % size(f.width)), y = static_cast<int>(i / size(f.width));
    Random random(x, y, seed), stripe(x / 5, y / (5 * layers), seed + 1);
    coc[i] = static_cast<std::int32_t>(4000 * std::floor(3 * stripe.next()) +
                                       1.1 * DEFRAY_JUMP_QUANTA * random.next());
    for (std::size_t c = 0; c < 3; ++c) {
      const bool is_number = random.next() < 0.98;
      channels[c][i] = is_number ? static_cast<float>(10 * random.next()) : std::nanf("");
    }
  }
  f.coc_quanta = coc;
  for (Plane& plane : channels) f.channels.emplace_back(std::move(plane));
  return f;
}

/// A colour `out` pixels outside the edge at (x, y), inwards of which (dx, dy) leads.
double continued(const Frame& f, const Plane& plane, int x, int y, int dx, int dy, int out) {
  const int inside = dx ? f.width - 2 * f.margin : f.height - 2 * f.margin;
  double sum = 0;
  int count = 0;
  for (int d = 0; d < std::min({out, inside, f.margin}); ++d) {
    const std::size_t at = f.index(x + d * dx, y + d * dy);
    if (d > 0) {
      const std::size_t before = f.index(x + (d - 1) * dx, y + (d - 1) * dy);
      if (std::abs(f.coc_quanta[at] - f.coc_quanta[before]) > DEFRAY_JUMP_QUANTA) break;
    }
    sum += plane[at];
    ++count;
  }
  return sum / count;
}

/// Rows first; columns then begin with what rows have left beyond the corners.
Plane expected_colours(const Frame& f, Plane plane) {
  const int m = f.margin, right = f.width - m - 1, below = f.height - m - 1;
  const auto set = [&](int x, int y, double value) {
    if (std::isfinite(value)) plane[f.index(x, y)] = static_cast<float>(value);
  };
  for (int y = m; y <= below; ++y) {
    for (int out = 1; out <= m; ++out) {
      set(m - out, y, continued(f, plane, m, y, 1, 0, out));
      set(right + out, y, continued(f, plane, right, y, -1, 0, out));
    }
  }
  for (int x = 0; x < f.width; ++x) {
    for (int out = 1; out <= m; ++out) {
      set(x, m - out, continued(f, plane, x, m, 0, 1, out));
      set(x, below + out, continued(f, plane, x, below, 0, -1, out));
    }
  }
  return plane;
}

void expect_continued(Frame f) {
  std::vector<Plane> before;
  for (const Values<float>& channel : f.channels) {
    before.emplace_back(channel.begin(), channel.end());
  }
  continue_colours(f);
  for (std::size_t c = 0; c < 3; ++c) {
    const Plane expected = expected_colours(f, before[c]);
    for (std::size_t i = 0; i < expected.size(); ++i) {
      if (std::isnan(expected[i])) {
        EXPECT_TRUE(std::isnan(f.channels[c][i])) << i;
      } else {
        EXPECT_NEAR(f.channels[c][i], expected[i], 1e-4) << i;
      }
    }
  }
}

TEST(BorderColours, AreMeansOfTheEdgesSurface) {
  for (std::uint32_t seed = 0; seed < 12; ++seed) {
    SCOPED_TRACE(seed);
    const int layers = 1 + static_cast<int>(seed % 2), margin = static_cast<int>(seed * 2 % 7) + 3;
    const int width = seed == 3 ? 4 : 17, height = seed == 4 ? 2 : 14;
    expect_continued(striped(width, height, margin, layers, seed));
  }
}

TEST(BorderColours, OfAPictureNarrowerThanItsMarginAreOfThePictureAlone) {
  for (const auto& [width, height] : {std::pair{4, 11}, {11, 4}, {1, 1}}) {
    Frame f = striped(width, height, 9, 1, 5);
    f.coc_quanta = std::vector<std::int32_t>(f.surfaces());  // one surface
    expect_continued(f);
  }
}

TEST(BorderColours, WithoutAMarginNothingChanges) {
  Frame f = striped(8, 6, 0, 1, 1);
  const Plane before(f.channels[0].begin(), f.channels[0].end());
  continue_colours(f);
  EXPECT_EQ(hash_of_planes({f.channels[0]}), hash_of({before}));
}

}  // namespace
}  // namespace defray::test::border_colours_test
