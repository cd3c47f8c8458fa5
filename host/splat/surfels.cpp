#include "splat/surfels.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/parallel.h"
#include "splat/cells.h"
#include "splat/cloud_points.h"
#include "splat/placed_points.h"
#include "splat/sides.h"

namespace defray {
namespace {

/// Colours above this are hardly light of which white is 1.
constexpr float bright_colour = 50;

Vec3 vec(const std::array<float, 3>& v) { return {v[0], v[1], v[2]}; }

void check_counts(const PointCloud& cloud) {
  const std::size_t points = cloud.positions.size();
  const auto check = [&](const char* what, std::size_t count) {
    if (count == 0 || count == points) return;
    fail(ErrorKind::usage, "{} has {} values: the cloud has {} points", field(what), count, points);
  };
  check("normals", cloud.normals.size());
  check("radii", cloud.radii.size());
  check("colours", cloud.colours.size());
  check("alpha", cloud.alpha.size());
}

double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Estimated spacings are no larger than this times the median of those around. What is farther
/// apart than that, or than so many times the median of all, may be a stray of a scan.
constexpr double most_over_others = 3;

/// Strays become dots as wide as what they lie among; discs as wide as they lie apart would hide
/// what is behind. Takes their sizes as given.
void limit_to_others(double of_all, std::vector<std::uint8_t>& has_size, CloudPoints& cloud) {
  std::vector<double> limited(cloud.points.size());
  parallel_for_each(limited.size(), [&](std::size_t i) {
    limited[i] = cloud.points[i].spacing;
    std::vector<double> others;
    for (const std::uint32_t k : cloud.around.of(i)) others.push_back(cloud.points[k].spacing);
    if (has_size[i] || others.empty()) return;
    const double of_others = median(others), small = std::min(of_all, of_others);
    if (!(limited[i] > most_over_others * small)) return;
    has_size[i] = is_stray(cloud, i);
    limited[i] = has_size[i] ? small : std::min(limited[i], most_over_others * of_others);
  });
  for (std::size_t i = 0; i < limited.size(); ++i) cloud.points[i].spacing = limited[i];
}

/// Spacings, given or from the points around; of a single point there are none around. Returns
/// which are given.
std::vector<std::uint8_t> set_spacings(const PointCloud& given_cloud,
                                       const std::vector<std::uint32_t>& kept, CloudPoints& cloud,
                                       Surfels& out) {
  std::vector<CloudPoint>& points = cloud.points;
  std::vector<std::uint8_t> has_radius(points.size());
  std::size_t without = 0;
  std::vector<double> known;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const float given = given_cloud.radii.empty() ? 0 : given_cloud.radii[kept[i]];
    const bool is_given = std::isfinite(given) && given > 0;
    has_radius[i] = is_given;
    if (is_given && given > most_units) {
      fail(ErrorKind::input, "point {} has the radius {:g}: allowed are up to {:g}", kept[i], given,
           most_units);
    }
    without += !given_cloud.radii.empty() && !is_given;
    points[i].spacing = is_given ? static_cast<double>(given) : spacing_of(cloud, i);
    if (points[i].spacing > 0) known.push_back(points[i].spacing);
  }
  if (known.empty()) {
    const std::size_t all = given_cloud.positions.size();
    const auto placed = static_cast<std::size_t>(
        std::count_if(given_cloud.positions.begin(), given_cloud.positions.end(), is_finite));
    fail(
        ErrorKind::input,
        "the cloud's points ({}{}) all lie in one place, and say nothing of their size: give them "
        "a radius",
        placed == 1 ? "one" : std::to_string(placed),
        placed == all ? "" : fmt::format("; {} without a finite place are left out", all - placed));
  }
  if (without > 0) {
    out.notes.push_back(
        fmt::format("{} points have no radius above 0: estimated from those around", without));
  }
  const double of_all = median(known);
  for (CloudPoint& p : points) {
    if (!(p.spacing > 0)) p.spacing = of_all;
  }
  limit_to_others(of_all, has_radius, cloud);
  return has_radius;
}

/// What is estimated has no outside: that of the given ones around it.
void take_sides(const std::vector<std::uint8_t>& is_given, CloudPoints& cloud) {
  parallel_for_each(cloud.points.size(), [&](std::size_t i) {
    if (is_given[i]) return;
    double same = 0;
    for (const std::uint32_t other : cloud.around.of(i)) {
      if (is_given[other]) same += dot(cloud.points[i].normal, cloud.points[other].normal);
    }
    if (same < 0) cloud.points[i].normal = -cloud.points[i].normal;
  });
}

/// Points whose normal most of those around point against: flipped. Of two sheets closer to each
/// other than their points are, about half do.
std::size_t count_flipped(const CloudPoints& cloud) {
  const auto is_flipped = [&](std::size_t i) {
    const auto around = cloud.around.of(i);
    const auto against = std::count_if(around.begin(), around.end(), [&](std::uint32_t other) {
      return dot(cloud.points[i].normal, cloud.points[other].normal) < -0.5;
    });
    return 4 * static_cast<std::size_t>(against) > 3 * around.size();
  };
  std::vector<std::uint8_t> flipped(cloud.points.size());
  parallel_for_each(flipped.size(), [&](std::size_t i) { flipped[i] = is_flipped(i); });
  return static_cast<std::size_t>(std::count(flipped.begin(), flipped.end(), 1));
}

/// Unit normals, given or estimated.
void set_normals(const PointCloud& given_cloud, const std::vector<std::uint32_t>& kept,
                 CloudPoints& cloud, Surfels& out) {
  std::vector<CloudPoint>& points = cloud.points;
  std::vector<std::uint8_t> is_given(points.size(), 0);
  parallel_for_each(points.size(), [&](std::size_t i) {
    if (!given_cloud.normals.empty() && is_finite(given_cloud.normals[kept[i]])) {
      const Vec3 given = vec(given_cloud.normals[kept[i]]);
      is_given[i] = length(given) > 1e-20;
      if (is_given[i]) points[i].normal = normalized(given);
    }
    if (!is_given[i]) points[i].normal = estimated_normal(cloud, i);
  });
  take_sides(is_given, cloud);
  const auto given = std::count(is_given.begin(), is_given.end(), 1);
  out.has_normals = given > 0;
  if (!out.has_normals) find_sides(cloud);
  if (!given_cloud.normals.empty() && given < static_cast<std::ptrdiff_t>(points.size())) {
    out.notes.push_back(fmt::format("{} points have no normal: estimated from those around",
                                    points.size() - static_cast<std::size_t>(given)));
  }
  const std::size_t flipped = given > 0 ? count_flipped(cloud) : 0;
  if (flipped > 0) {
    out.notes.push_back(
        fmt::format("{} points have normals against those around, and are seen from the other "
                    "side alone: flipped?",
                    flipped));
  }
}

DefraySplatNode surfel_of(const PointCloud& cloud, std::uint32_t index, const CloudPoint& point,
                          const PointWeight& weight) {
  DefraySplatNode n{};
  const auto& place = cloud.positions[index];
  n.x = place[0];
  n.y = place[1];
  n.z = place[2];
  const Vec3 spanned = point.normal * weight.area;
  n.area_x = static_cast<float>(spanned.x);
  n.area_y = static_cast<float>(spanned.y);
  n.area_z = static_cast<float>(spanned.z);
  n.variance = static_cast<float>(std::pow(basis_deviation * point.spacing, 2));
  n.cover = static_cast<float>(weight.cover);
  n.both_sides = point.is_two_sided;
  constexpr float grey = 0.5f;
  n.a = cloud.alpha.empty() ? 1 : cloud.alpha[index];
  n.r = n.a * (cloud.colours.empty() ? grey : cloud.colours[index][0]);
  n.g = n.a * (cloud.colours.empty() ? grey : cloud.colours[index][1]);
  n.b = n.a * (cloud.colours.empty() ? grey : cloud.colours[index][2]);
  return n;
}

void check_colours(const PointCloud& cloud) {
  for (std::size_t i = 0; i < cloud.colours.size(); ++i) {
    if (is_finite(cloud.colours[i])) continue;
    fail(ErrorKind::input, "point {} has the colour {} {} {}: allowed are finite numbers", i,
         cloud.colours[i][0], cloud.colours[i][1], cloud.colours[i][2]);
  }
  for (std::size_t i = 0; i < cloud.alpha.size(); ++i) {
    if (cloud.alpha[i] >= 0 && cloud.alpha[i] <= 1) continue;
    fail(ErrorKind::input, "point {} has alpha {}: allowed are 0 to 1", i, cloud.alpha[i]);
  }
}

void note_bright_colours(const PointCloud& cloud, Surfels& out) {
  float largest = 0;
  for (const auto& c : cloud.colours) largest = std::max({largest, c[0], c[1], c[2]});
  if (largest > bright_colour) {
    out.notes.push_back(fmt::format(
        "colours go up to {:g}: floats are linear light, of which white is 1", largest));
  }
}

}  // namespace

Surfels make_surfels(const PointCloud& cloud, const Progress& progress) {
  check_counts(cloud);
  check_colours(cloud);
  for (const double o : cloud.origin) {
    if (!std::isfinite(o)) {
      fail(ErrorKind::input, "the cloud's {} has {}: allowed are finite numbers", field("origin"),
           o);
    }
  }
  Surfels out;
  out.notes = cloud.notes;
  note_bright_colours(cloud, out);
  out.has_colours = !cloud.colours.empty();
  const std::vector<std::uint32_t> kept = placed_points(cloud, out.notes);
  std::vector<std::array<float, 3>> places;
  for (const std::uint32_t i : kept) places.push_back(cloud.positions[i]);
  Neighbours around(places, neighbour_count);
  CloudPoints known{std::move(places), std::vector<CloudPoint>(kept.size()), std::move(around)};
  const std::vector<std::uint8_t> has_radius = set_spacings(cloud, kept, known, out);
  set_normals(cloud, kept, known, out);
  find_cells(known, has_radius);
  const std::vector<PointWeight> weights = weigh(known, progress);
  for (std::size_t i = 0; i < kept.size(); ++i) {
    out.points.push_back(surfel_of(cloud, kept[i], known.points[i], weights[i]));
  }
  return out;
}

}  // namespace defray
