// Kernel splat_resolve: splats to pixels, layer by layer.
#include <cmath>

#include "base/random.h"
#include "splat_support.h"

namespace defray::test::splat_resolve_test {
namespace {

DefraySplatParams picture(int width, int height, bool averages = false) {
  DefraySplatParams p{};
  p.width = word(width);
  p.height = word(height);
  p.cutoff = 2.5f;
  p.averages = averages;
  p.layers = 100;
  return p;
}

/// A wide Gaussian about a pixel's centre, so that its weight there is `weight`.
DefraySplat splat_at(int x, int y, float weight, float z, float half_depth, float colour,
                     float alpha = 1) {
  DefraySplat s{};
  s.x = static_cast<float>(x) + 0.5f;
  s.y = static_cast<float>(y) + 0.5f;
  s.conic_xx = s.conic_yy = 0.5f;
  s.amplitude = weight;
  s.z = z;
  s.z_near = z - half_depth;
  s.z_far = z + half_depth;
  s.first_x = x;
  s.end_x = x + 1;
  s.first_y = y;
  s.end_y = y + 1;
  s.r = s.g = s.b = colour * alpha;
  s.a = alpha;
  return s;
}

/// Red and alpha of pixel (1, 1).
std::array<float, 2> resolved(const std::vector<DefraySplat>& splats, bool averages = false) {
  const SplatPlanes planes =
      device().splat_resolve(in_order({splats, {}}), picture(3, 3, averages));
  return {planes.colour[0][4], planes.colour[3][4]};
}

TEST(SplatResolve, FragmentsOfOneSurfaceAddUp) {
  const auto [red, alpha] =
      resolved({splat_at(1, 1, 0.5f, 3, 0.1f, 1), splat_at(1, 1, 0.25f, 3.1f, 0.1f, 0)});
  EXPECT_FLOAT_EQ(red, 0.5f);
  EXPECT_FLOAT_EQ(alpha, 0.75f);
}

TEST(SplatResolve, WhatLiesBehindShowsThroughWhatIsLeft) {
  const std::vector<DefraySplat> splats{splat_at(1, 1, 0.5f, 5, 0.1f, 0.8f),
                                        splat_at(1, 1, 0.5f, 3, 0.1f, 0.2f),
                                        splat_at(1, 1, 0.25f, 3, 0.1f, 0.2f)};
  const auto [red, alpha] = resolved(splats);
  EXPECT_FLOAT_EQ(red, 0.75f * 0.2f + 0.25f * 0.5f * 0.8f);
  EXPECT_FLOAT_EQ(alpha, 0.75f + 0.25f * 0.5f);
  // Their order in the list does not matter.
  EXPECT_EQ(resolved({splats[2], splats[0], splats[1]}), resolved(splats));
}

TEST(SplatResolve, RangesThatMeetAreOneSurfaceEvenIfTheirEndsDoNot) {
  // 3 +- 0.5, 3.8 +- 0.5, 4.6 +- 0.5: the first and the last meet through the second.
  const auto [red, alpha] =
      resolved({splat_at(1, 1, 0.4f, 3, 0.5f, 1), splat_at(1, 1, 0.4f, 3.8f, 0.5f, 1),
                splat_at(1, 1, 0.2f, 4.6f, 0.5f, 0)});
  EXPECT_FLOAT_EQ(red, 0.8f);
  EXPECT_FLOAT_EQ(alpha, 1);
}

TEST(SplatResolve, MoreThanAWholeIsTheNearestOrTheAverage) {
  const std::vector<DefraySplat> splats{splat_at(1, 1, 0.75f, 3, 0.2f, 1),
                                        splat_at(1, 1, 0.75f, 3.1f, 0.2f, 0)};
  EXPECT_FLOAT_EQ(resolved(splats)[0], 0.75f);
  EXPECT_FLOAT_EQ(resolved(splats)[1], 1);
  EXPECT_FLOAT_EQ(resolved(splats, true)[0], 0.5f);
  EXPECT_FLOAT_EQ(resolved(splats, true)[1], 1);
}

TEST(SplatResolve, TransparentSurfacesLetThrough) {
  const auto [red, alpha] =
      resolved({splat_at(1, 1, 1, 3, 0.1f, 0.5f, 0.25f), splat_at(1, 1, 1, 5, 0.1f, 1)});
  EXPECT_FLOAT_EQ(red, 0.25f * 0.5f + 0.75f);
  EXPECT_FLOAT_EQ(alpha, 1);
}

TEST(SplatResolve, DepthIsTheNearestSurfacesAndFragmentsAreCounted) {
  const std::vector<DefraySplat> splats{
      splat_at(1, 1, 0.5f, 4, 2, 1), splat_at(1, 1, 0.4f, 3, 0.1f, 1),
      splat_at(1, 1, 1, 9, 0.1f, 1), splat_at(1, 1, 1, 11, 0.1f, 1)};
  const SplatPlanes planes = device().splat_resolve(in_order({splats, {}}), picture(3, 3));
  EXPECT_FLOAT_EQ(planes.depth[4], (0.5f * 4 + 0.4f * 3) / 0.9f);
  EXPECT_EQ(planes.fragments[4], 3) << "nothing shows through the third";
  EXPECT_EQ(planes.depth[0], INFINITY);
  EXPECT_EQ(planes.fragments[0], 0);
  EXPECT_EQ(planes.colour[3][0], 0);
}

TEST(SplatResolve, WhatIsAllTransparentHasNoDepth) {
  const SplatPlanes planes = device().splat_resolve(
      in_order({{splat_at(1, 1, 0.5f, 3, 0.1f, 1, 0), splat_at(1, 1, 0.5f, 5, 0.1f, 1)}, {}}),
      picture(3, 3, false));
  EXPECT_EQ(planes.depth[4], 5);
  EXPECT_EQ(planes.fragments[4], 2);
}

TEST(SplatResolve, GaussiansAreExponentialsToTheirCutOff) {
  DefraySplat s = splat_at(20, 0, 1, 3, 0.1f, 1);
  s.conic_xx = s.conic_yy = 0.01f;
  s.first_x = 0;
  s.end_x = 41;
  const SplatPlanes planes = device().splat_resolve({{s}, {}}, picture(41, 1));
  for (int x = 0; x < 41; ++x) {
    const double form = 0.01 * (x - 20) * (x - 20);
    const double exact = form < 2.5 ? std::exp(-form) : 0;
    // Roundings of the exponent, up to 3.6, and of the polynomial's last three terms.
    EXPECT_NEAR(planes.colour[0][size(x)], exact, exact * 1e-6) << x;
  }
}

TEST(SplatResolve, DiscsAreEvenInsideAndFallTowardsTheirEnd) {
  DefraySplat s = splat_at(20, 20, 1, 3, 0.1f, 1);
  // t / D with D = 100 and T = 300: even within 14.1 px, nothing from 17.3 on.
  s.conic_xx = s.conic_yy = 0.01f;
  s.disc_top = 3;
  s.disc_bulge = 1.5f;
  s.amplitude = 0.5f;
  s.first_x = s.first_y = 0;
  s.end_x = s.end_y = 41;
  DefraySplatParams p = picture(41, 41);
  const auto row = [&] {
    const SplatPlanes planes = device().splat_resolve({{s}, {}}, p);
    return std::vector<float>(planes.colour[0].begin() + 20 * 41,
                              planes.colour[0].begin() + 21 * 41);
  };
  const std::vector<float> even = row();
  for (int x = 0; x < 41; ++x) {
    const double left = std::clamp(3 - 0.01 * (x - 20) * (x - 20), 0.0, 1.0);
    EXPECT_NEAR(even[size(x)], 0.5 * left * left * (1 + 1.5 * (1 - left)), 1e-6) << x;
  }
  EXPECT_EQ(even[20], 0.5f);
  EXPECT_EQ(even[34], 0.5f);
  EXPECT_EQ(even[38], 0);
  // It leans, and is seen from one side up to where that is 0; from both sides beyond.
  s.lean_x = 0.05f;
  const std::vector<float> leaning = row();
  EXPECT_FLOAT_EQ(leaning[25], 0.75f);
  EXPECT_FLOAT_EQ(leaning[15], 0.25f);
  EXPECT_EQ(leaning[9], 0);
  s.back = -1;
  EXPECT_NEAR(row()[8], 0.1, 1e-6);
}

TEST(SplatResolve, LayersAreTheNearestSurfacesAndTheRestIsCounted) {
  std::vector<DefraySplat> splats;
  for (const float z : {3.0f, 4.0f, 5.0f}) splats.push_back(splat_at(1, 1, 1, z, 0.1f, z, 0.5f));
  DefraySplatParams p = picture(3, 3);
  const auto drawn = [&](int layers) {
    p.layers = layers;
    return device().splat_resolve(in_order({splats, {}}), p);
  };
  EXPECT_FLOAT_EQ(drawn(3).colour[3][4], 0.875f);
  EXPECT_EQ(drawn(3).fragments[4], 3);
  EXPECT_FLOAT_EQ(drawn(2).colour[3][4], 0.75f);
  EXPECT_FLOAT_EQ(drawn(2).colour[0][4], 1.5f + 0.5f * 2);
  EXPECT_EQ(drawn(2).fragments[4], -2);
  EXPECT_EQ(drawn(1).fragments[4], -1);
  EXPECT_EQ(drawn(1).fragments[0], 0);
  // What hides all behind it leaves nothing out.
  splats[1].a = 1;
  EXPECT_EQ(drawn(2).fragments[4], 2);
}

/// Splats of all sizes over a picture of this size.
Splats random_splats(Size size, int count, std::uint32_t seed) {
  std::vector<DefraySplatNode> nodes;
  std::vector<DefraySplatRidge> ridges(DEFRAY_SPLAT_RIDGES);
  for (int i = 0; i < count; ++i) {
    Random random(i, 5, seed);
    DefraySplatNode n{};
    const double z = 1 + 3 * random.next();
    n.x = static_cast<float>(z * (random.next() - 0.5));
    n.y = static_cast<float>(z * (random.next() - 0.5));
    n.z = static_cast<float>(4 - z);
    n.area_z = static_cast<float>(0.002 * random.next());
    n.variance = n.area_z;
    n.cover = 1;
    n.r = static_cast<float>(random.next());
    n.a = 1;
    if (i % 3 == 0) {
      n.ridges = word(static_cast<int>(ridges.size() / DEFRAY_SPLAT_RIDGES));
      ridges.push_back({0.02f, 0.01f, 0});
      ridges.push_back({-0.01f, 0.03f, 0});
    }
    nodes.push_back(n);
  }
  DefraySplatParams p = view_of(std::max(size.width, size.height), 4, 40);
  p.width = word(size.width);
  p.height = word(size.height);
  return in_order(twins().splat_project(nodes, ridges, p));
}

TEST(SplatResolve, EqualsTwinAtAwkwardSizesAndInGroupsOfTiles) {
  for (const Size size : awkward_sizes()) {
    if (is_slow_device() && size.width > 64) continue;
    const auto splats = random_splats(size, is_slow_device() ? 60 : 600, 3);
    const DefraySplatParams p = picture(size.width, size.height);
    const SplatPlanes twin = twins().splat_resolve(splats, p),
                      own = device().splat_resolve(splats, p);
    EXPECT_EQ(hash_of(own.colour), hash_of(twin.colour)) << size.width << "x" << size.height;
    EXPECT_EQ(own.depth, twin.depth);
    EXPECT_EQ(own.fragments, twin.fragments);
    const InBands bands(session(), 256);  // a tile's list at a time
    const SplatPlanes in_groups = device().splat_resolve(splats, p);
    EXPECT_EQ(hash_of(in_groups.colour), hash_of(twin.colour)) << size.width << "x" << size.height;
  }
}

TEST(SplatResolve, WithoutSplatsThePictureIsEmpty) {
  const SplatPlanes planes = device().splat_resolve({}, picture(5, 3));
  EXPECT_EQ(planes.colour[3], Plane(15, 0.0f));
  EXPECT_EQ(planes.depth, Plane(15, INFINITY));
  EXPECT_TRUE(device().splat_project({}, {}, picture(5, 3)).all.empty());
}

}  // namespace
}  // namespace defray::test::splat_resolve_test
