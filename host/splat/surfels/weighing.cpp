// Weights of a cloud's points: Krivanek & Zara 2003, section 6.3, but found on the surface itself
// instead of in rendered pictures.
#include <algorithm>
#include <cmath>

#include "base/falloff.h"
#include "base/parallel.h"
#include "splat/surfels/cells.h"

namespace defray {
namespace {

/// What sums should be where they are sharp, and where they are blurred, so that none is less than
/// 0.99: more does not count within a surface, but at its edges, of which blur has more.
constexpr double aim = 1.045, blurred_aim = 1.01;
/// How weights are found: from sums at each point and around it, in so many steps. Those above the
/// aim weigh too_much of what lower ones do, and count up to most_excess; but as much as lower ones
/// along edges, which would grow.
struct Search {
  int steps;
  float around;  ///< How far around, in spacings; 0: at the point's sites.
  float too_much, most_excess;
  bool by_faces;  ///< Sums are each face's own.
};
/// Of areas: as large as the surface is, they are what counts where it is blurred.
constexpr Search of_areas{4, 0.5f, 0.3f, 1, false};
/// Where it is sharp what is behind shines through wherever sums are less than 1; what is more does
/// not count (SplatMerge). Of points on a jittered grid the least sum is 0.99; with all areas
/// alike, and 1.03, it is 0.91. At a ridge what is seen of the one face flat is seen of the other
/// from its edge, so each covers itself all over: with ridges as all else the least sum of regular
/// solids and prisms is 0.81. Sums are more there than twice their aim, and 0.96 in the next row if
/// that counts. (perf/notes/point_clouds.md.)
constexpr Search of_cover{4, 0, 0.1f, 0.02f, true};
/// So much a step may change areas by more than the square of what sums lack: by its sixth power
/// gaps between random points close in 4 steps instead of 16; without a limit those at corners
/// grow. Not along edges, which would grow, too.
constexpr float most_eager = 1.5f;
/// Where normals turn faster there is a ridge: 1 - their cosine at a distance of one spacing (14
/// degrees), and times its square farther away. Balls of 300 points turn by 12.
constexpr double ridge_turn = 0.03;
/// A point without another so near, in spacings, is a disc by itself.
constexpr double alone_from = 4;
/// Basis functions end, lowered, where splat_project lets them by default. If they did not, beside
/// ridges, where some are three times as high, tails that are not drawn would count.
constexpr float default_cutoff = 2.5f;
/// Planes that lie flatter than this to a line of sight (a cosine) are seen as if by it.
constexpr float least_facing = 1e-3f;

/// At the point and at its sites, so that they make whole vectors.
constexpr std::size_t lanes = site_count + 1;
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
    const TangentAxes axes = axes_across(point.normal);
    u = axis(axes.u);
    v = axis(axes.v);
  }
};

/// Finds areas with which the basis functions add up to 1 all over the surface, by the steps of
/// Richardson and Lucy: each area times the mean, by its own basis function, of what sums lack; its
/// square, which takes half as many steps, or more (eager). In floats, and in units of each point's
/// own size.
class Weighing {
 public:
  explicit Weighing(const CloudPoints& cloud)
      : cloud_(cloud),
        tangents_(cloud.points.begin(), cloud.points.end()),
        areas_(cloud.points.size(), 1.0f),
        lacks_(cloud.points.size()) {
    for (std::size_t k = 0; k < site_count; ++k) {
      towards_u_[k + 1] = static_cast<float>(site_directions()[k].x);
      towards_v_[k + 1] = static_cast<float>(site_directions()[k].y);
    }
  }

  void step(const Search& search) {
    search_ = search;
    parallel_for_each(areas_.size(), [&](std::size_t i) { look(i); });
    parallel_for_each(areas_.size(), [&](std::size_t i) { areas_[i] *= change(i); });
  }

  std::vector<double> areas() const {
    std::vector<double> areas;
    for (std::size_t i = 0; i < areas_.size(); ++i) {
      const double area = is_alone(i) ? M_PI : static_cast<double>(areas_[i]);
      areas.push_back(area * square(cloud_.points[i].spacing));
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

  /// Up to this cosine between their normals two points lie on either side of a ridge.
  double face_cosine(std::size_t of, std::size_t at) const {
    const Vec3 d = cloud_.place(at) - cloud_.place(of);
    const double spacing = std::min(cloud_.points[at].spacing, cloud_.points[of].spacing);
    return 1 - ridge_turn * std::max(1.0, dot(d, d) / square(spacing));
  }

  /// What a point's basis function of area 1, in squares of its spacing, covers at the sites of
  /// another, or itself, seen along the normal there: where that line meets the plane on which the
  /// basis function lies.
  Sites basis(std::size_t of, std::size_t at) const {
    const Tangent &point = tangents_[of], &there = tangents_[at];
    const float same = dot(point.normal, there.normal);
    const double least = search_.by_faces ? face_cosine(of, at) : 0;
    if (cloud_.are_apart(of, at, static_cast<double>(same), least)) return {};
    if (search_.by_faces && cloud_.is_beyond_ridge(of, at)) return {};
    const float inverse = 1 / std::max(there.spacing, 1e-30f);
    Axis d;
    for (std::size_t k = 0; k < 3; ++k) {
      d[k] = (cloud_.places[at][k] - cloud_.places[of][k]) * inverse;
    }
    Sites far{};
    for (std::size_t k = 0; k < site_count; ++k) {
      far[k + 1] = search_.around > 0 ? search_.around : cloud_.points[at].sites[k];
    }
    const float du = 2 * dot(d, there.u), dv = 2 * dot(d, there.v), own = dot(d, d);
    const float nu = dot(point.normal, there.u), nv = dot(point.normal, there.v);
    const float above = dot(d, point.normal);
    const float on = 1 / std::copysign(std::max(std::fabs(same), least_facing), same);
    const float twice = 2 * dot(d, there.normal);
    const float size = there.spacing / (static_cast<float>(basis_deviation) * point.spacing);
    Sites covered;
    for (std::size_t k = 0; k < lanes; ++k) {
      const float u = far[k] * towards_u_[k], v = far[k] * towards_v_[k];
      const float square = own + far[k] * far[k] + u * du + v * dv;
      const float down = (above + u * nu + v * nv) * on;  // along the line, to the plane
      const float power = 0.5f * size * size * (square + down * (down - twice));
      covered[k] = top_ * (falloff(power < default_cutoff ? power : default_cutoff) - lowered_);
    }
    return covered;
  }

  void look(std::size_t point) {
    Sites sums{};
    const auto add = [&](std::size_t of) {
      const Sites covered = basis(of, point);
      for (std::size_t k = 0; k < lanes; ++k) sums[k] += areas_[of] * covered[k];
    };
    add(point);
    for (const std::uint32_t i : cloud_.around.of(point)) add(i);
    const double covered = cloud_.points[point].covered;
    const auto wanted = static_cast<float>(aim * covered);
    const float weight = covered < 1 ? 1 : search_.too_much;
    const float most = covered < 1 ? 1 : search_.most_excess;
    for (std::size_t k = 0; k < lanes; ++k) {
      const float lack = wanted / sums[k];
      lacks_[point][k] = lack < 1 ? 1 - weight * std::min(1 - lack, most) : lack;
    }
  }

  float factor(std::size_t point) const {
    float weights = 0, sum = 0;
    const auto add = [&](std::size_t at) {
      const Sites covered = basis(point, at);
      for (std::size_t k = 0; k < lanes; ++k) {
        weights += covered[k];
        sum += covered[k] * lacks_[at][k];
      }
    };
    add(point);
    for (const std::uint32_t i : cloud_.around.of(point)) add(i);
    return sum / weights;
  }

  float change(std::size_t point) const {
    const float f = factor(point), twice = f * f;
    if (!search_.by_faces || cloud_.points[point].covered < 1) return twice;
    return std::max(twice, std::min(twice * twice * twice, most_eager));
  }

  /// A basis function of area 1, in squares of its point's spacing: top_ (e^-power - lowered_).
  const float lowered_ = falloff(default_cutoff);
  const float top_ = 1 / (2 * static_cast<float>(M_PI * square(basis_deviation)) *
                          (1 - lowered_ * (1 + default_cutoff)));

  const CloudPoints& cloud_;
  Search search_{};
  Sites towards_u_{}, towards_v_{};  ///< The sites' directions; of the point itself none.
  std::vector<Tangent> tangents_;
  std::vector<float> areas_;  ///< Of the points' basis functions, in squares of their spacings.
  /// What sums at a point's sites are to be multiplied by.
  std::vector<Sites> lacks_;
};

}  // namespace

std::vector<PointWeight> weigh(const CloudPoints& cloud, const Progress& progress) {
  Weighing weighing(cloud);
  int done = 0;
  const auto areas_of = [&](const Search& search) {
    for (int i = 0; i < search.steps; ++i) {
      weighing.step(search);
      if (progress) progress(static_cast<double>(++done) / (of_areas.steps + of_cover.steps));
    }
    return weighing.areas();
  };
  const std::vector<double> blurred = areas_of(of_areas), sharp = areas_of(of_cover);
  std::vector<PointWeight> weights;
  for (std::size_t i = 0; i < blurred.size(); ++i) {
    const double area = blurred[i] * (blurred_aim / aim);
    weights.push_back({area, sharp[i] / area});
  }
  return weights;
}

}  // namespace defray
