#include "splat/surfels/estimates.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/median.h"
#include "base/parallel.h"
#include "splat/surfels/placed_points.h"
#include "splat/surfels/sides.h"
#include "splat/surfels/strays.h"

namespace defray {
namespace {

Vec3 vec(const std::array<float, 3>& v) { return {v[0], v[1], v[2]}; }

/// Estimated spacings are no larger than this times the median of those around. What is farther
/// apart than that, or than most_over_all times the median of all, may be a stray of a scan.
constexpr double most_over_others = 3, most_over_all = 5;

/// Strays become dots as wide as what they lie among; discs as wide as they lie apart would hide
/// what is behind. Takes their sizes as given.
void limit_to_others(double of_all, std::vector<std::uint8_t>& has_size, CloudPoints& cloud,
                     std::vector<std::string>& notes) {
  const std::size_t count = cloud.points.size();
  std::vector<double> of_others(count, of_all);
  std::vector<std::uint8_t> may_be_stray(count);
  parallel_for_each(count, [&](std::size_t i) {
    std::vector<double> others;
    for (const std::uint32_t k : cloud.around.alike(i)) others.push_back(cloud.points[k].spacing);
    if (!others.empty()) of_others[i] = median(others);
    may_be_stray[i] =
        !has_size[i] && !others.empty() &&
        cloud.points[i].spacing > std::min(most_over_all * of_all, most_over_others * of_others[i]);
  });
  const std::vector<std::uint8_t> is_stray = find_strays(cloud, may_be_stray);
  for (std::size_t i = 0; i < count; ++i) {
    double& spacing = cloud.points[i].spacing;
    if (is_stray[i]) spacing = std::min(of_all, of_others[i]);
    if (!has_size[i]) spacing = std::min(spacing, most_over_others * of_others[i]);
    has_size[i] |= is_stray[i];
  }
  if (const auto strays = std::count(is_stray.begin(), is_stray.end(), 1); strays > 0) {
    notes.push_back(
        fmt::format("{} points lie apart from all surfaces: drawn as small as the others", strays));
  }
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

/// Points whose normal most of those around point against, and hardly one with: flipped. Of two
/// sheets closer to each other than their points are about half do, and where a body stands on a
/// floor some are with each.
std::size_t count_flipped(const CloudPoints& cloud) {
  const auto is_flipped = [&](std::size_t i) {
    const auto around = cloud.around.of(i);
    std::size_t against = 0, with = 0;
    for (const std::uint32_t other : around) {
      const double cosine = dot(cloud.points[i].normal, cloud.points[other].normal);
      against += cosine < -0.5;
      with += cosine > 0.5;
    }
    return 4 * against > 3 * around.size() && 10 * with <= around.size();
  };
  std::vector<std::uint8_t> flipped(cloud.points.size());
  parallel_for_each(flipped.size(), [&](std::size_t i) { flipped[i] = is_flipped(i); });
  return static_cast<std::size_t>(std::count(flipped.begin(), flipped.end(), 1));
}

/// More points than this share on lines are a scanner's, not wires.
constexpr double many_lines = 0.1;

/// What lies along lines says nothing of a surface between them.
void note_lines(const std::vector<std::uint8_t>& is_line, std::vector<std::string>& notes) {
  const auto all = static_cast<double>(is_line.size());
  const double share = static_cast<double>(std::count(is_line.begin(), is_line.end(), 1)) / all;
  if (share < many_lines || is_line.size() <= neighbour_count) return;
  notes.push_back(fmt::format(
      "{:.0f} % of the points lie along lines farther apart than the {} nearest points reach, and "
      "show the gaps between: where they are a scanner's, thin them out along the lines",
      100 * share, neighbour_count));
}

}  // namespace

std::vector<std::uint8_t> set_spacings(const PointCloud& given_cloud,
                                       const std::vector<std::uint32_t>& kept, CloudPoints& cloud,
                                       std::vector<std::string>& notes) {
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
    notes.push_back(
        fmt::format("{} points have no radius above 0: estimated from those around", without));
  }
  const double of_all = median(known);
  for (CloudPoint& p : points) {
    if (!(p.spacing > 0)) p.spacing = of_all;
  }
  limit_to_others(of_all, has_radius, cloud, notes);
  return has_radius;
}

bool set_normals(const PointCloud& given_cloud, const std::vector<std::uint32_t>& kept,
                 CloudPoints& cloud, std::vector<std::string>& notes) {
  std::vector<CloudPoint>& points = cloud.points;
  std::vector<std::uint8_t> is_given(points.size(), 0), is_line(points.size(), 0);
  parallel_for_each(points.size(), [&](std::size_t i) {
    if (!given_cloud.normals.empty() && is_finite(given_cloud.normals[kept[i]])) {
      const Vec3 given = vec(given_cloud.normals[kept[i]]);
      is_given[i] = length(given) > 1e-20;
      if (is_given[i]) points[i].normal = normalized(given);
    }
    if (is_given[i]) return;
    const EstimatedSurface found = estimate_surface(cloud, i);
    points[i].normal = found.normal;
    is_line[i] = found.is_line;
  });
  note_lines(is_line, notes);
  take_sides(is_given, cloud);
  const auto given = std::count(is_given.begin(), is_given.end(), 1);
  if (given == 0) find_sides(cloud);
  if (!given_cloud.normals.empty() && given < static_cast<std::ptrdiff_t>(points.size())) {
    notes.push_back(fmt::format("{} points have no normal: estimated from those around",
                                points.size() - static_cast<std::size_t>(given)));
  }
  const std::size_t flipped = given > 0 ? count_flipped(cloud) : 0;
  if (flipped > 0) {
    notes.push_back(
        fmt::format("{} points have normals against those around, and are seen from the other "
                    "side alone: flipped?",
                    flipped));
  }
  return given > 0;
}

}  // namespace defray
