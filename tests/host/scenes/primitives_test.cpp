// What the built-in scenes' rays hit, against brute force.
#include "scenes/geometry/primitives.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "scenes/builtin/block_grid.h"
#include "scenes/geometry/bvh.h"
#include "support.h"

namespace defray::test::primitives_test {
namespace {

constexpr double far_away = 1e10;

class RandomVectors {
 public:
  explicit RandomVectors(std::uint32_t seed) : random_(seed) {}
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  Vec3 in_cube(double half) {
    return {between(-half, half), between(-half, half), between(-half, half)};
  }

 private:
  std::mt19937 random_;
};

std::vector<std::unique_ptr<Primitive>> random_primitives(int count) {
  RandomVectors random(7);
  std::vector<std::unique_ptr<Primitive>> all;
  for (int i = 0; i < count; ++i) {
    const Vec3 at = random.in_cube(10), size = random.in_cube(1);
    const Vec3 positive{std::fabs(size.x) + 0.01, std::fabs(size.y) + 0.01, 0.5};
    const Texture colour = plain(random.in_cube(1));
    if (i % 4 == 0) {
      all.push_back(std::make_unique<Ball>(at, positive.x, colour));
    } else if (i % 4 == 1) {
      all.push_back(std::make_unique<Box>(at, positive, random.between(-3, 3), colour));
    } else if (i % 4 == 2) {
      all.push_back(std::make_unique<Quad>(at, size, cross(size, random.in_cube(1)), colour));
    } else {
      all.push_back(std::make_unique<Rectangle>(at.x, at.y, at.x + 1, at.y + 1, at.z, colour));
    }
  }
  return all;
}

TEST(Bvh, FindsWhatBruteForceFinds) {
  for (const int count : {0, 1, 2, 3, 5, 97, 1000}) {
    const auto primitives = random_primitives(count);
    const Bvh bvh(primitives);
    RandomVectors random(11);
    int hits = 0;
    for (int i = 0; i < 2000; ++i) {
      const Vec3 origin = random.in_cube(15);
      const Ray ray{origin, random.in_cube(10) - origin, i % 3 == 0 ? 0.4 : 0};
      Hit nearest{far_away, {}, {}}, found{far_away, {}, {}};
      for (const auto& primitive : primitives) primitive->intersect(ray, nearest);
      ASSERT_EQ(bvh.intersect(ray, found), nearest.t < far_away) << count << " ray " << i;
      ASSERT_EQ(found.t, nearest.t);
      ASSERT_EQ(found.colour.x, nearest.colour.x);
      hits += nearest.t < far_away;
    }
    EXPECT_GE(hits, count == 1000 ? 200 : 0);
  }
}

TEST(Primitives, ABoxWithoutDepthIsARectangle) {
  const Box sheet({0, 0, 5}, {1, 2, 0}, 0, plain({1, 1, 1}));
  Hit hit{far_away, {}, {}};
  EXPECT_TRUE(sheet.intersect({{0.5, 1.5, 0}, {0, 0, 1}, 0}, hit));
  EXPECT_EQ(hit.t, 5);
  EXPECT_EQ(hit.normal.z, -1);
  hit.t = far_away;
  EXPECT_FALSE(sheet.intersect({{1.5, 1.5, 0}, {0, 0, 1}, 0}, hit));
}

TEST(Primitives, ABoxIsBoundedByItsCorners) {
  RandomVectors random(3);
  for (int i = 0; i < 50; ++i) {
    const Vec3 centre = random.in_cube(10), d = random.in_cube(2);
    const Vec3 half{std::fabs(d.x), std::fabs(d.y), std::fabs(d.z)};
    const double yaw = random.between(-7, 7);
    Vec3 low{far_away, far_away, far_away}, high = low * -1;
    for (int corner = 0; corner < 8; ++corner) {
      const double x = corner & 1 ? half.x : -half.x, z = corner & 2 ? half.z : -half.z;
      const Vec3 at =
          centre + Vec3{x * std::cos(yaw) - z * std::sin(yaw), corner & 4 ? half.y : -half.y,
                        x * std::sin(yaw) + z * std::cos(yaw)};
      low = {std::fmin(low.x, at.x), std::fmin(low.y, at.y), std::fmin(low.z, at.z)};
      high = {std::fmax(high.x, at.x), std::fmax(high.y, at.y), std::fmax(high.z, at.z)};
    }
    const Bounds bounds = Box(centre, half, yaw, plain({})).bounds();
    for (const double off :
         {bounds.low.x - low.x, bounds.low.y - low.y, bounds.low.z - low.z, bounds.high.x - high.x,
          bounds.high.y - high.y, bounds.high.z - high.z}) {
      EXPECT_NEAR(off, 0, 1e-12) << i;
    }
  }
}

TEST(Primitives, HitsLieInTheirBoundsWithNormalsTowardsTheRay) {
  const auto primitives = random_primitives(200);
  RandomVectors random(5);
  int hits = 0;
  for (const auto& primitive : primitives) {
    const Bounds b = primitive->bounds();
    const Vec3 middle = (b.low + b.high) / 2;
    for (int i = 0; i < 20; ++i) {
      const Vec3 origin = middle + random.in_cube(4);
      const Ray ray{origin, middle + random.in_cube(0.3) - origin};
      Hit hit{far_away, {}, {}};
      if (!primitive->intersect(ray, hit)) continue;
      ++hits;
      const Vec3 p = ray.origin + ray.direction * hit.t;
      for (const auto axis : {&Vec3::x, &Vec3::y, &Vec3::z}) {
        EXPECT_GE(p.*axis, b.low.*axis - 1e-6);
        EXPECT_LE(p.*axis, b.high.*axis + 1e-6);
      }
      EXPECT_LE(dot(hit.normal, ray.direction), 0);
      // Entered once: behind the hit, a convex shape is not entered again.
      Hit again{far_away, {}, {}};
      EXPECT_FALSE(primitive->intersect({ray.origin, ray.direction, hit.t * (1 + 1e-9)}, again));
    }
  }
  EXPECT_GT(hits, 1000);
}

BlockWorld random_world() {
  std::mt19937 random(3);
  BlockWorld world(16, 11);
  for (int z = 0; z < 16; ++z) {
    for (int x = 0; x < 16; ++x) {
      const int top = static_cast<int>(random() % 11);  // some tiles end low, some high
      for (int y = 0; y < (x < 8 ? top : top / 3); ++y) {
        if (random() % 3 == 0) world.set(x, y, z, Block::dirt);
      }
    }
  }
  return world;
}

struct Stretch {
  double enter, leave;
};

/// Where a ray is inside solid blocks: each block's own stretch, touching ones made one.
std::vector<Stretch> solid_stretches(const BlockWorld& world, const Ray& ray) {
  std::vector<Stretch> all;
  for (int z = 0; z < world.size(); ++z) {
    for (int y = 0; y < world.height(); ++y) {
      for (int x = 0; x < world.size(); ++x) {
        if (world.at(x, y, z) == Block::air) continue;
        const double low[3] = {x * block_size, y * block_size, z * block_size};
        const double o[3] = {ray.origin.x, ray.origin.y, ray.origin.z};
        const double d[3] = {ray.direction.x, ray.direction.y, ray.direction.z};
        Stretch s{-far_away, far_away};
        for (int a = 0; a < 3; ++a) {
          const double t0 = (low[a] - o[a]) / d[a], t1 = (low[a] + block_size - o[a]) / d[a];
          s = {std::max(s.enter, std::min(t0, t1)), std::min(s.leave, std::max(t0, t1))};
        }
        if (s.enter < s.leave && s.leave > 0) all.push_back(s);
      }
    }
  }
  std::sort(all.begin(), all.end(), [](auto& a, auto& b) { return a.enter < b.enter; });
  std::vector<Stretch> merged;
  for (const Stretch& s : all) {
    if (!merged.empty() && s.enter < merged.back().leave + 1e-9) {
      merged.back().leave = std::max(merged.back().leave, s.leave);
    } else {
      merged.push_back(s);
    }
  }
  return merged;
}

/// World axes as the camera's: rays need no turning.
constexpr Viewpoint unturned{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

TEST(BlockGrid, WalksToWhatBruteForceFinds) {
  const BlockWorld world = random_world();
  const BlockGrid grid(world, unturned);
  RandomVectors random(13);
  int hits = 0;
  for (int i = 0; i < 1500; ++i) {
    const Vec3 target{random.between(0, 8), random.between(0, 5), random.between(0, 8)};
    Vec3 origin{random.between(-6, 14), random.between(-4, 12), random.between(-6, 14)};
    if (i % 4 == 0) origin = {target.x, 9, target.z + 1e-9};  // nearly along an axis
    const Ray ray{origin, target - origin};
    for (double from = 0; from < far_away;) {
      double expected = far_away;
      for (const Stretch& s : solid_stretches(world, ray)) {
        if (s.enter > from) expected = std::min(expected, s.enter);
      }
      Hit hit{far_away, {}, {}};
      grid.intersect({ray.origin, ray.direction, from}, hit);
      ASSERT_NEAR(hit.t, expected, 1e-7) << "ray " << i << " from " << from;
      if (expected < far_away) {
        EXPECT_LT(dot(hit.normal, ray.direction), 0);
        EXPECT_GT(hit.colour.x, 0);
        ++hits;
      }
      from = expected + 1e-8;
    }
  }
  EXPECT_GT(hits, 1500);
}

TEST(BlockGrid, TakesRaysAlongAxes) {
  BlockWorld world(8, 4);
  world.set(3, 2, 5, Block::wood);
  const BlockGrid grid(world, unturned);
  Hit hit{far_away, {}, {}};
  ASSERT_TRUE(grid.intersect({{1.75, 1.25, -3}, {0, 0, 1}}, hit));
  EXPECT_NEAR(hit.t, 5.5, 1e-12);
  EXPECT_EQ(hit.normal.z, -1);
  hit = {far_away, {}, {}};
  EXPECT_FALSE(grid.intersect({{1.75, 9, -3}, {0, 0, 1}}, hit));       // over it
  EXPECT_FALSE(grid.intersect({{1.75, 1.25, -3}, {0, 0, -1}}, hit));   // away from it
  EXPECT_FALSE(grid.intersect({{1.75, 1.25, 2.75}, {0, 1, 0}}, hit));  // out of it
}

TEST(BlockWorld, HasEveryKindOfBlockAndTreesUpToSixMetres) {
  const BlockWorld world = make_block_world(7, 4);
  int count[9] = {};
  for (int z = 0; z < world.size(); ++z) {
    for (int x = 0; x < world.size(); ++x) {
      int trunk = 0;
      for (int y = 0; y < world.height(); ++y) {
        ++count[static_cast<int>(world.at(x, y, z))];
        if (world.at(x, y, z) == Block::wood) ++trunk;
      }
      EXPECT_LE(trunk * block_size, 6);
    }
  }
  for (const int blocks : count) EXPECT_GT(blocks, 0);
}

TEST(DiamondSquare, IsRoughAtEveryScaleAndRepeats) {
  const std::vector<double> heights = diamond_square(5, 9);
  ASSERT_EQ(heights.size(), 33u * 33u);
  EXPECT_EQ(heights, diamond_square(5, 9));
  EXPECT_NE(heights, diamond_square(5, 10));
  EXPECT_EQ(*std::min_element(heights.begin(), heights.end()), 0);
  EXPECT_EQ(*std::max_element(heights.begin(), heights.end()), 1);
  double near = 0, far = 0;
  for (std::size_t i = 0; i + 16 < 33; ++i) {
    near += std::fabs(heights[33 * i + i + 1] - heights[33 * i + i]);
    far += std::fabs(heights[33 * i + i + 16] - heights[33 * i + i]);
  }
  EXPECT_GT(near, 0);
  EXPECT_LT(near, far / 2);
}

}  // namespace
}  // namespace defray::test::primitives_test
