#include "splat/surfels/surfels.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "splat/surfels/cells.h"
#include "splat/surfels/cloud_points.h"
#include "splat/surfels/coarser.h"
#include "splat/surfels/estimates.h"
#include "splat/surfels/placed_points.h"
#include "splat/surfels/ridges.h"
#include "splat/surfels/smoothing.h"

namespace defray {
namespace {

/// Colours above this are hardly light of which white is 1.
constexpr float bright_colour = 50;

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

DefraySplatNode surfel_of(const PointCloud& cloud, std::uint32_t index,
                          const std::array<float, 3>& place, const CloudPoint& point,
                          const PointWeight& weight) {
  DefraySplatNode n{};
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

/// The set of a point's ridges.
std::uint32_t add_ridges(const CloudPoint& point, std::vector<DefraySplatRidge>& ridges) {
  if (!(length(point.ridges[0]) > 0)) return 0;
  const auto set = static_cast<std::uint32_t>(ridges.size() / DEFRAY_SPLAT_RIDGES);
  for (const Vec3& to : point.ridges) {
    ridges.push_back(
        {static_cast<float>(to.x), static_cast<float>(to.y), static_cast<float>(to.z)});
  }
  return set;
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
  add_coarser(places, around);
  CloudPoints known{std::move(places), std::vector<CloudPoint>(kept.size()), std::move(around)};
  const std::vector<std::uint8_t> has_radius = set_spacings(cloud, kept, known, out.notes);
  out.has_normals = set_normals(cloud, kept, known, out.notes);
  smooth(known);
  if (out.has_normals) find_ridges(known);
  find_cells(known, has_radius);
  const std::vector<PointWeight> weights = weigh(known, progress);
  for (std::size_t i = 0; i < kept.size(); ++i) {
    out.points.push_back(surfel_of(cloud, kept[i], known.places[i], known.points[i], weights[i]));
    out.points.back().ridges = add_ridges(known.points[i], out.ridges);
  }
  return out;
}

}  // namespace defray
