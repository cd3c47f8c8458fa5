#include "validation/splat_input.h"

#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "base/vec3.h"
#include "splat/view.h"

namespace defray::validation {
namespace {

constexpr std::size_t most_nodes = 2000;

/// From -1 to 1.
double either_side(Random& random) { return 2 * random.next() - 1; }

/// A covariance whose eigenvalues are at least 0: the sum of two outer products.
void set_low_pass(DefraySplatNode& n, double scale, Random& random) {
  double sums[6] = {};
  for (int i = 0; i < 2; ++i) {
    const double v[3] = {scale * either_side(random), scale * either_side(random),
                         scale * either_side(random)};
    int k = 0;
    for (int a = 0; a < 3; ++a) {
      for (int b = a; b < 3; ++b) sums[k++] += v[a] * v[b];
    }
  }
  float* const values[] = {&n.low_xx, &n.low_xy, &n.low_xz, &n.low_yy, &n.low_yz, &n.low_zz};
  for (int k = 0; k < 6; ++k) *values[k] = static_cast<float>(sums[k]);
}

/// One or two, on the tangent plane.
void add_ridges(DefraySplatNode& n, Random& random, std::vector<DefraySplatRidge>& ridges) {
  n.ridges = static_cast<std::uint32_t>(ridges.size() / DEFRAY_SPLAT_RIDGES);
  const double reach = 2 * std::sqrt(static_cast<double>(n.variance));
  const Vec3 normal = normalized({n.area_x, n.area_y, n.area_z});
  const int count = random.next() < 0.5 ? 1 : DEFRAY_SPLAT_RIDGES;
  for (int i = 0; i < DEFRAY_SPLAT_RIDGES; ++i) {
    const Vec3 any{either_side(random), either_side(random), either_side(random)};
    const Vec3 to = (any - normal * dot(any, normal)) * (i < count ? reach : 0);
    ridges.push_back(
        {static_cast<float>(to.x), static_cast<float>(to.y), static_cast<float>(to.z)});
  }
}

float colour_of(const Case& c, Random& random) {
  const double plain = random.next();
  switch (c.colours) {
    case Colours::plain:
      break;
    case Colours::wild:
      return static_cast<float>(std::exp2(12 * plain - 6) * (plain < 0.1 ? -1 : 1));
    case Colours::extreme:
      return plain < 0.2 ? 1e30f : plain < 0.4 ? -0.0f : 65504;
    case Colours::nonfinite:
      return plain < 0.05 ? NAN : plain < 0.1 ? INFINITY : 0.5f;
  }
  return static_cast<float>(plain);
}

DefraySplatNode node_of(const Case& c, std::uint32_t index) {
  // Ties: several nodes in each place.
  const std::uint32_t place = c.pattern == Pattern::ties ? index / 5 : index;
  Random where(static_cast<int>(place), 1, c.seed), random(static_cast<int>(index), 2, c.seed);
  const double z = c.pattern == Pattern::constant ? 3 : std::exp2(6 * where.next() - 3);
  DefraySplatNode n{};
  n.x = static_cast<float>(0.8 * z * either_side(where));
  n.y = static_cast<float>(0.8 * z * either_side(where));
  n.z = static_cast<float>(random.next() < 0.05 ? -z : z);
  const double area = std::pow(z * 0.1, 2) * random.next();
  const Vec3 normal =
      normalized({either_side(random), either_side(random), -1.2 * random.next() + 0.2});
  const double spanned = random.next() < 0.03 ? 0 : area;
  n.area_x = static_cast<float>(spanned * normal.x);
  n.area_y = static_cast<float>(spanned * normal.y);
  n.area_z = static_cast<float>(spanned * normal.z);
  n.variance = static_cast<float>(0.36 * area);
  n.cover = static_cast<float>(0.5 + 2 * random.next());
  n.both_sides = static_cast<float>(random.next());
  if (c.pattern != Pattern::checker && random.next() < 0.7) {
    set_low_pass(n, 0.1 * z * random.next(), random);
  }
  n.r = colour_of(c, random);
  n.g = colour_of(c, random);
  n.b = colour_of(c, random);
  // Some are all transparent.
  n.a = c.seed % 3 == 0 ? static_cast<float>(std::max(1.25 * random.next() - 0.25, 0.0)) : 1;
  return n;
}

}  // namespace

SplatInput splat_input(const Case& c) {
  const std::size_t pixels = static_cast<std::size_t>(c.width) * static_cast<std::size_t>(c.height);
  const std::size_t count = std::clamp<std::size_t>(pixels / 4, 3, most_nodes);
  SplatInput input{{}, std::vector<DefraySplatRidge>(DEFRAY_SPLAT_RIDGES)};
  for (std::uint32_t i = 0; i < count; ++i) {
    DefraySplatNode& n = input.nodes.emplace_back(node_of(c, i));
    Random random(static_cast<int>(i), 5, c.seed);
    if (n.low_xx == 0 && random.next() < 0.7) add_ridges(n, random, input.ridges);
  }
  return input;
}

DefraySplatParams splat_params(const Case& c) {
  Random random(3, 4, c.seed);
  DefraySplatParams p{};
  p.width = static_cast<std::uint32_t>(c.width);
  p.height = static_cast<std::uint32_t>(c.height);
  const Vec3 forward = normalized({0.1 * either_side(random), 0.1 * either_side(random), 1});
  const Vec3 right = normalized(cross({0, 1, 0}, forward)), down = cross(forward, right);
  float* const rows[] = {&p.right_x, &p.down_x, &p.forward_x};
  const Vec3* const axes[] = {&right, &down, &forward};
  for (int i = 0; i < 3; ++i) {
    rows[i][0] = static_cast<float>(axes[i]->x);
    rows[i][1] = static_cast<float>(axes[i]->y);
    rows[i][2] = static_cast<float>(axes[i]->z);
  }
  p.eye_z = static_cast<float>(-0.1 * random.next());
  p.eye_x = static_cast<float>(0.05 * either_side(random));
  p.eye_y = static_cast<float>(0.05 * either_side(random));
  p.near_units = 0.2f;
  p.focal_px = static_cast<float>(0.6 * std::max(c.width, c.height));
  p.centre_x = static_cast<float>(c.width) / 2;
  p.centre_y = static_cast<float>(c.height) / 2;
  p.focus_is_infinite = std::isinf(c.focus);
  p.coc_scale_px = p.focus_is_infinite ? 0 : static_cast<float>(c.coc_px);
  p.focus_units = p.focus_is_infinite ? 0 : static_cast<float>(c.focus);
  p.infinite_focus_scale = p.focus_is_infinite ? static_cast<float>(c.coc_px) : 0;
  p.limit_px = 1 << 20;
  p.lens_units = lens_radius_of(p);
  put_cutoff(1 + 0.5 * (c.seed % 8), p);
  p.one_sided = c.seed % 4 == 1;
  p.has_discs = c.seed % 3 != 1;
  p.has_headlight = c.seed % 5 == 2;
  p.averages = c.seed % 2;
  p.layers = c.seed % 3 == 0 ? 1 + static_cast<int>(c.seed % 4) : 1000;
  return p;
}

}  // namespace defray::validation
