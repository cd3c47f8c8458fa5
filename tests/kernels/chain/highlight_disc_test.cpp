// One very bright pixel through the RDB's stages: an even disc of the aperture's shape with all of
// its light, at any circle of confusion, against the exact area of the shape in each pixel.
#include <cmath>
#include <numbers>
#include <numeric>

#include "lens/aperture_mask.h"
#include "lens/coc.h"
#include "methods/method.h"
#include "support.h"

namespace defray::test::highlight_disc_test {
namespace {

using Corner = std::array<double, 2>;
constexpr float light = 5000;

/// Of a convex polygon, what lies before (sign 1) or behind (-1) a line across an axis.
std::vector<Corner> cut(const std::vector<Corner>& polygon, std::size_t axis, double at, int sign) {
  std::vector<Corner> out;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Corner &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double from = sign * (at - a[axis]), to = sign * (at - b[axis]);
    if (from >= 0) out.push_back(a);
    if (from * to >= 0) continue;
    const double t = from / (from - to);
    out.push_back({a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])});
  }
  return out;
}

double area(const std::vector<Corner>& polygon) {
  double twice = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Corner &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    twice += a[0] * b[1] - b[0] * a[1];
  }
  return std::fabs(twice) / 2;
}

/// The aperture's shape in pixels around a source, signed radius r. A circle is a polygon of so
/// many corners that 1e-6 of its area lacks.
std::vector<Corner> shape_of(int blades, double r) {
  const int corners = blades == 0 ? 4096 : blades;
  std::vector<Corner> polygon;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * (i + 0.5) / corners;  // a blade on the right
    polygon.push_back({r * std::cos(angle), r * std::sin(angle)});
  }
  return polygon;
}

/// What the lens's rim leaves of a shape when it is off by `strength` radii r to the upper left:
/// radii around a point that is in both, to corners so many that 1e-6 of a circle lacks.
std::vector<Corner> behind_rim(const std::vector<Corner>& shape, double r, double strength) {
  const double off = -r * strength / std::numbers::sqrt2;
  std::vector<Corner> polygon;
  for (int i = 0; i < 4096; ++i) {
    const double angle = 2 * std::numbers::pi * i / 4096;
    const Corner to{std::cos(angle), std::sin(angle)};
    const double along = (to[0] + to[1]) * off / 2, far = off * off / 2;
    double most = along + std::sqrt(along * along + r * r - far);
    for (std::size_t k = 0; k < shape.size(); ++k) {
      const Corner a{shape[k][0] - off / 2, shape[k][1] - off / 2};
      const Corner& next = shape[(k + 1) % shape.size()];
      const Corner edge{next[0] - off / 2 - a[0], next[1] - off / 2 - a[1]};
      const double across = to[0] * edge[1] - to[1] * edge[0];
      if (across > 0) most = std::fmin(most, (a[0] * edge[1] - a[1] * edge[0]) / across);
    }
    polygon.push_back({off / 2 + most * to[0], off / 2 + most * to[1]});
  }
  return polygon;
}

/// Share of the shape in each pixel of a square frame with the source in its middle's pixel.
std::vector<double> shares(const std::vector<Corner>& shape, int side) {
  std::vector<double> out(static_cast<std::size_t>(side * side));
  const double all = area(shape), left = -side / 2 - 0.5;
  for (int x = 0; x < side; ++x) {
    const auto column = cut(cut(shape, 0, left + x, -1), 0, left + x + 1, 1);
    for (int y = 0; y < side && !column.empty(); ++y) {
      const auto pixel = cut(cut(column, 1, left + y, -1), 1, left + y + 1, 1);
      out[static_cast<std::size_t>(y * side + x)] = area(pixel) / all;
    }
  }
  return out;
}

/// What the lens makes of one bright pixel on grey.
struct Disc {
  int side;
  double radius_px;
  Plane picture;
  double grey;
  /// What comes on top of the grey, per light.
  double at(std::size_t i) const { return (double{picture[i]} - grey) / (double{light} - grey); }
};

Disc render_disc(std::int32_t quanta, float grey, const ChainSettings& settings, Backend& on) {
  const double radius = quanta / 256.0;
  const int side = 2 * (static_cast<int>(std::fabs(radius)) + 6) + 1;
  const Plane depth(static_cast<std::size_t>(side * side), 4.0f);
  const std::vector<std::int32_t> coc(depth.size(), quanta);
  Plane picture(depth.size(), grey);
  picture[depth.size() / 2] = light;
  MethodSettings method;
  method.chain = settings;
  Frame frame{side, side, coc, depth, {picture}};
  frame.display_width = frame.display_height = 1 << 20;    // its lower right corner, so that
  frame.origin_x = frame.origin_y = (1 << 20) - side / 2;  // the rim is the same all over
  return {side, radius, apply_method(frame, method, on).colour[0], double{grey}};
}

/// Errors of a disc.
struct Ghosts {
  double energy = 0;    ///< Of all light.
  double uneven = 0;    ///< (Largest - smallest) / mean of the pixels wholly within.
  double worst_px = 0;  ///< Of any pixel: as area of the shape.
  int inside = 0;       ///< Pixels wholly within.
};

/// `exact`: the shape's share in each pixel.
Ghosts ghosts_of(const Disc& disc, const std::vector<double>& exact, double area_px) {
  Ghosts g;
  double sum = 0, inside_sum = 0, least = HUGE_VAL, most = 0;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    const double share = disc.at(i);
    sum += share;
    g.worst_px = std::fmax(g.worst_px, std::fabs(share - exact[i]) * area_px);
    if (exact[i] * area_px < 1 - 1e-9) continue;
    ++g.inside;
    inside_sum += share;
    least = std::fmin(least, share);
    most = std::fmax(most, share);
  }
  g.energy = sum - 1;
  if (g.inside > 0) g.uneven = (most - least) * g.inside / inside_sum;
  return g;
}

/// How far a pixel's area may be off for a radius, px^2. The aperture is a picture of texels that
/// are evenly covered: where the rim leaves the pixel, twice, half a texel at most; and a texel's
/// coverage is known to 1/16 (8 x 8 points).
double bound_px(double radius_px) {
  const double texel = 2 * std::fabs(radius_px) / ApertureMask::side, along_rim = 2 / texel + 2;
  return texel * texel * (1 + along_rim / 16);
}

std::vector<double> radii() {
  if (is_slow_device()) return {0.3, 1.5, 5};
  if (!takes_long_tests()) return {0.3, 0.77, 2, 8, 34.7};
  return {0.3, 0.5, 0.77, 1, 1.5, 2, 3.3, 5, 8, 13, 21, 34.7, 55, 90, 128};
}

ChainSettings with_blades(int blades) {
  ChainSettings settings;
  settings.aperture.blades = blades;
  return settings;
}

TEST(HighlightDisc, IsEvenAndKeepsItsLightAtAnyRadius) {
  for (const int blades : {0, 6}) {
    for (const double radius : radii()) {
      for (const int sign : {1, -1}) {
        const auto quanta = static_cast<std::int32_t>(std::lround(256 * radius)) * sign;
        const auto shape = shape_of(blades, quanta / 256.0);
        for (const float grey : {0.0f, 0.18f}) {
          if (radius > 50 && (grey == 0) != (sign > 0)) continue;  // large frames take their time
          const Disc disc = render_disc(quanta, grey, with_blades(blades), device());
          const Ghosts g = ghosts_of(disc, shares(shape, disc.side), area(shape));
          SCOPED_TRACE(testing::Message()
                       << "radius " << disc.radius_px << ", blades " << blades << ", on " << grey);
          EXPECT_NEAR(g.energy, 0, 0.005);
          EXPECT_LE(g.uneven, 0.02);
          EXPECT_LE(g.worst_px, bound_px(radius));
          EXPECT_TRUE(g.inside > 0 || radius < 1);
        }
      }
    }
  }
}

TEST(HighlightDisc, KeepsTheLightThatTheRimLeaves) {
  SKIP_UNLESS_FULL();
  for (const double strength : {0.001, 0.5, 1.0}) {
    for (const int blades : {0, 6}) {
      for (const double radius : radii()) {
        if (radius > 50) continue;
        for (const int sign : {1, -1}) {
          const auto quanta = static_cast<std::int32_t>(std::lround(256 * radius)) * sign;
          const double r = quanta / 256.0;
          const auto shape = behind_rim(shape_of(blades, r), r, strength);
          ChainSettings settings = with_blades(blades);
          settings.aperture.cats_eye = strength;
          const Disc disc = render_disc(quanta, 0.18f, settings, device());
          const Ghosts g = ghosts_of(disc, shares(shape, disc.side), area(shape));
          SCOPED_TRACE(testing::Message()
                       << "radius " << r << ", strength " << strength << ", blades " << blades);
          EXPECT_NEAR(g.energy, 0, 0.005);
          EXPECT_LE(g.uneven, 0.02);
          // Strips of 1/16 px or less: one is off by half of it where the rim runs along it.
          EXPECT_LE(g.worst_px, bound_px(radius) + 1.0 / 32);
        }
      }
    }
  }
}

// A post in focus on the right, half of column 35: rays see it or not, light is veiled by half.
TEST(HighlightDisc, AnEdgeThatCutsItIsEven) {
  constexpr int side = 61, edge = 35;
  std::vector<std::int32_t> coc;
  Plane depth, picture;
  for (int i = 0; i < side * side; ++i) {
    const int x = i % side;
    coc.push_back(x > edge ? 0 : 12 * 256);
    depth.push_back(x > edge ? 2.0f : 9.0f);
    picture.push_back(x > edge ? 0.3f : x == edge ? 0.175f : 0.05f);
  }
  picture[side * side / 2] = light;
  MethodSettings method;
  method.chain = ChainSettings{};
  const Plane out = apply_method({side, side, coc, depth, {picture}}, method, device()).colour[0];
  const double level = light / (std::numbers::pi * 12 * 12);
  for (int y = side / 2 - 8; y <= side / 2 + 8; ++y) {
    const auto row = out.begin() + y * side;
    EXPECT_NEAR(row[edge - 3] / level, 1, 0.03) << y;
    EXPECT_NEAR(row[edge] / level, 0.5, 0.1) << y;
    EXPECT_NEAR(row[edge + 3], 0.3, 0.01) << y;
  }
  EXPECT_EQ(hash_of({out}),
            hash_of(apply_method({side, side, coc, depth, {picture}}, method, twins()).colour));
}

TEST(HighlightDisc, ChangesAsLittleAsItsRadius) {
  // The smallest step; at 3 px the neighbourhood's samples begin to move.
  for (const double radius : {0.3, 0.5, 0.77, 1.0, 1.5, 2.0, 3.0, 8.0, 34.7}) {
    if (is_slow_device() && radius > 3) continue;
    const auto quanta = static_cast<std::int32_t>(std::lround(256 * radius));
    const Disc a = render_disc(quanta, 0.18f, {}, device());
    const Disc b = render_disc(quanta + 1, 0.18f, {}, device());
    ASSERT_EQ(a.side, b.side);
    const auto exact_a = shares(shape_of(0, a.radius_px), a.side);
    const auto exact_b = shares(shape_of(0, b.radius_px), b.side);
    double moved = 0, exact = 0;
    for (std::size_t i = 0; i < exact_a.size(); ++i) {
      moved += std::fabs(b.at(i) - a.at(i));
      exact += std::fabs(exact_b[i] - exact_a[i]);
    }
    EXPECT_LE(moved, exact + 0.002) << radius;  // texels along the rim
  }
}

TEST(HighlightDisc, TwinsGiveTheSameDisc) {
  for (const int blades : {0, 6}) {
    for (const double radius : radii()) {
      if (radius > (takes_long_tests() ? 34.7 : 8)) continue;  // the scalar RDB takes its time
      for (const int sign : {1, -1}) {
        const auto quanta = static_cast<std::int32_t>(std::lround(256 * radius)) * sign;
        ChainSettings settings = with_blades(blades);
        settings.aperture.cats_eye = sign > 0 ? 0.5 : 0;
        const Plane kernel = render_disc(quanta, 0.18f, settings, device()).picture;
        EXPECT_EQ(hash_of({kernel}),
                  hash_of({render_disc(quanta, 0.18f, settings, twins()).picture}))
            << radius * sign << ", blades " << blades;
      }
    }
  }
}

TEST(HighlightDisc, WithoutTheStageItIsDots) {
  ChainSettings rays;
  rays.highlights = rays.soften = false;
  const auto shape = shape_of(0, 13);
  const Disc disc = render_disc(13 * 256, 0, rays, device());
  const Ghosts g = ghosts_of(disc, shares(shape, disc.side), area(shape));
  EXPECT_GT(g.uneven, 1);  // and that is what the first test would see
}

}  // namespace
}  // namespace defray::test::highlight_disc_test
