// Weights of a cloud's points: Krivanek & Zara 2003, section 6.3, but found on the surface itself
// instead of in rendered pictures.
#include <algorithm>
#include <cmath>

#include "base/falloff.h"
#include "base/parallel.h"
#include "kernels/splat_params.h"
#include "splat/cloud_points.h"

namespace defray {
namespace {

/// Steps in which weights are found, and where around a point sums are looked at: as far as this
/// along two axes, in distances of points.
constexpr int weighing_steps = 4;
constexpr float look_at = 0.5f;
/// Sums should be no less than 1, where what is behind would shine through; what is more does not
/// count (SplatMerge), and weighs a tenth as much, but not along edges, which would grow. Of points
/// on a jittered grid the least sum is then 0.99; with all alike, and 1.03, it is 0.91.
constexpr double aim = DEFRAY_SPLAT_AIM;
/// A point without another so near, in spacings, is a disc by itself.
constexpr double alone_from = 4;
constexpr float too_much = 0.1f;
/// A basis function is nothing where it is e to the minus this.
constexpr float nothing_from = 79;
/// Planes that lie flatter than this to a line of sight (a cosine) are seen as if by it.
constexpr float least_facing = 1e-3f;

/// At the point, and as far as look_at to either side along two axes; the rest are zeros, so that
/// they make whole vectors.
constexpr std::size_t site_count = 5, lanes = 8;
using Sites = std::array<float, lanes>;

using Axis = std::array<float, 3>;

float dot(const Axis& a, const Axis& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Axis axis(const Vec3& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}
constexpr double square(double x) { return x * x; }

/// The surface at a point.
struct Tangent {
  Axis normal, u, v;  ///< Unit; sites lie along u and v.
  float spacing;

  explicit Tangent(const CloudPoint& point)
      : normal(axis(point.normal)), spacing(static_cast<float>(point.spacing)) {
    const Vec3& n = point.normal;
    const Vec3 beside = normalized(cross(n, std::abs(n.x) < 0.8 ? Vec3{1, 0, 0} : Vec3{0, 1, 0}));
    u = axis(beside);
    v = axis(cross(n, beside));
  }
};

/// Finds areas with which the basis functions add up to 1 all over the surface, by the steps of
/// Richardson and Lucy: each area times the mean, by its own basis function, of what sums lack; its
/// square, which takes half as many steps. In floats, and in units of each point's own size.
class Weighing {
 public:
  explicit Weighing(const CloudPoints& cloud)
      : cloud_(cloud),
        tangents_(cloud.points.begin(), cloud.points.end()),
        heights_(cloud.points.size(), static_cast<float>(1 / whole_of_unit_height)),
        lacks_(cloud.points.size()) {}

  void step() {
    parallel_for_each(heights_.size(), [&](std::size_t i) { look(i); });
    parallel_for_each(heights_.size(), [&](std::size_t i) {
      const float f = factor(i);
      heights_[i] *= f * f;
    });
  }

  std::vector<double> areas() const {
    std::vector<double> areas;
    for (std::size_t i = 0; i < heights_.size(); ++i) {
      const double whole =
          is_alone(i) ? M_PI : static_cast<double>(heights_[i]) * whole_of_unit_height;
      areas.push_back(whole * square(cloud_.points[i].spacing));
    }
    return areas;
  }

 private:
  bool is_alone(std::size_t point) const {
    const auto around = cloud_.around.of(point);
    return std::none_of(around.begin(), around.end(), [&](std::uint32_t other) {
      return length(cloud_.place(other) - cloud_.place(point)) <
             alone_from * std::max(cloud_.points[point].spacing, cloud_.points[other].spacing);
    });
  }

  /// What a basis function of height 1 adds up to on its plane, in squares of its point's spacing.
  static constexpr double whole_of_unit_height = 2 * M_PI * square(basis_deviation);

  /// What a point's basis function of height 1 covers at the sites of another, or itself, seen
  /// along the normal there: where that line meets the plane on which the basis function lies.
  Sites basis(std::size_t of, std::size_t at) const {
    const Tangent &point = tangents_[of], &there = tangents_[at];
    const float same = dot(point.normal, there.normal);
    if (cloud_.is_oriented && !(same > 0)) return {};
    const float inverse = 1 / std::max(there.spacing, 1e-30f);
    Axis d;
    for (std::size_t k = 0; k < 3; ++k) {
      d[k] = (cloud_.places[at][k] - cloud_.places[of][k]) * inverse;
    }
    const float du = 2 * look_at * dot(d, there.u), dv = 2 * look_at * dot(d, there.v);
    const float own = dot(d, d), far = own + look_at * look_at;
    const Sites squares = {own, far + du, far - du, far + dv, far - dv};
    const float above = dot(d, point.normal);
    const float nu = look_at * dot(point.normal, there.u),
                nv = look_at * dot(point.normal, there.v);
    const Sites above_plane = {above, above + nu, above - nu, above + nv, above - nv};
    const float on = 1 / std::copysign(std::max(std::fabs(same), least_facing), same);
    const float twice = 2 * dot(d, there.normal);
    const float size = there.spacing / (static_cast<float>(basis_deviation) * point.spacing);
    Sites covered;
    for (std::size_t k = 0; k < lanes; ++k) {
      const float down = above_plane[k] * on;  // along the line, to the plane
      const float power = 0.5f * size * size * (squares[k] + down * (down - twice));
      covered[k] = falloff(power < nothing_from ? power : nothing_from);
    }
    return covered;
  }

  void look(std::size_t point) {
    Sites sums{};
    const auto add = [&](std::size_t of) {
      const Sites covered = basis(of, point);
      for (std::size_t k = 0; k < lanes; ++k) sums[k] += heights_[of] * covered[k];
    };
    add(point);
    for (const std::uint32_t i : cloud_.around.of(point)) add(i);
    const double covered = cloud_.points[point].covered;
    const auto wanted = static_cast<float>(aim * covered);
    const float weight = covered < 1 ? 1 : too_much;
    for (std::size_t k = 0; k < site_count; ++k) {
      const float lack = wanted / sums[k];
      lacks_[point][k] = lack < 1 ? 1 + weight * (lack - 1) : lack;
    }
  }

  float factor(std::size_t point) const {
    float weights = 0, sum = 0;
    const auto add = [&](std::size_t at) {
      const Sites covered = basis(point, at);
      for (std::size_t k = 0; k < site_count; ++k) {
        weights += covered[k];
        sum += covered[k] * lacks_[at][k];
      }
    };
    add(point);
    for (const std::uint32_t i : cloud_.around.of(point)) add(i);
    return sum / weights;
  }

  const CloudPoints& cloud_;
  std::vector<Tangent> tangents_;
  std::vector<float> heights_;  ///< Of the points' basis functions.
  /// What sums at a point's sites are to be multiplied by.
  std::vector<std::array<float, site_count>> lacks_;
};

}  // namespace

std::vector<double> weighed_areas(const CloudPoints& cloud, const Progress& progress) {
  Weighing weighing(cloud);
  for (int i = 0; i < weighing_steps; ++i) {
    weighing.step();
    if (progress) progress(static_cast<double>(i + 1) / weighing_steps);
  }
  return weighing.areas();
}

}  // namespace defray
