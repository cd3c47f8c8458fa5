#include "splat/surfels/coarser.h"

#include <algorithm>
#include <compare>

#include "base/median.h"
#include "base/parallel.h"
#include "splat/surfels/spread.h"

namespace defray {
namespace {

// What chose the numbers: cubes with a face 2 to 10 times as fine as the others, and bodies among
// up to 400 strays, which are coarser than all else, too (perf/notes/point_clouds.md).

/// From here on the directions in which others lie, their mean, are all to one side: of half a disc
/// it is 0.64, of random ones around a point 0.2.
constexpr double one_sided = 0.5;
/// The other side is where directions have this cosine to theirs or less.
constexpr double other_side = -0.3;
/// Neighbours of coarser points reach this much farther than the point's, or more, and they lie no
/// farther away than this times how far those reach.
constexpr double coarser_reach = 1.25, most_distance = 3;
/// So many are a surface, and not strays, if they lie in one with the point and the closest of each
/// of most of them do, this share of the places' variance across it, or less, and if most of them
/// are known: so many points have them among those around. Those of faces are by 9 to 19, of a
/// floor under a body now and then by 3 to 6, strays by 0 to 8.
constexpr std::size_t least_count = 3, closest_count = 8, least_known = 9;
constexpr double thickest = 0.03;

using AllPlaces = std::vector<std::array<float, 3>>;

Vec3 from_to(const AllPlaces& places, std::size_t from, std::size_t to) {
  const auto &a = places[from], &b = places[to];
  return Vec3{b[0], b[1], b[2]} - Vec3{a[0], a[1], a[2]};
}

/// The mean direction of the points around each that has them all on one side; else 0.
std::vector<Vec3> find_sides_of(const AllPlaces& places, const Neighbours& around) {
  std::vector<Vec3> sides(places.size());
  parallel_for_each(places.size(), [&](std::size_t i) {
    Vec3 sum{};
    for (const std::uint32_t other : around.of(i)) {
      const Vec3 d = from_to(places, i, other);
      if (dot(d, d) > 0) sum = sum + normalized(d);
    }
    if (length(sum) > one_sided * static_cast<double>(around.of(i).size())) {
      sides[i] = normalized(sum);
    }
  });
  return sides;
}

/// One on the other side of a point that has others on one side alone.
struct Coarser {
  std::uint32_t point;
  double distance;
  std::uint32_t other;

  auto operator<=>(const Coarser&) const = default;
};

/// All of them, each point's nearest first.
std::vector<Coarser> find_coarser(const AllPlaces& places, const Neighbours& around) {
  const std::vector<Vec3> sides = find_sides_of(places, around);
  const auto reach = [&](std::uint32_t point) {
    return length(from_to(places, point, around.of(point).back()));
  };
  std::vector<Coarser> found;
  for (std::uint32_t other = 0; other < places.size(); ++other) {
    for (const std::uint32_t point : around.of(other)) {
      const Vec3 d = from_to(places, point, other);
      const double distance = length(d), own = reach(point);
      if (!(dot(d, sides[point]) < other_side * distance) || distance > most_distance * own ||
          reach(other) < coarser_reach * own) {
        continue;
      }
      const auto known = around.of(point);
      if (std::find(known.begin(), known.end(), other) != known.end()) continue;
      found.push_back({point, distance, other});
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

double thickness_around(const AllPlaces& places, std::size_t point,
                        std::span<const std::uint32_t> others) {
  std::vector<Vec3> all{{}};
  for (const std::uint32_t other : others) all.push_back(from_to(places, point, other));
  return spread_of(all).thickness();
}

/// How many points have each among those around them.
std::vector<std::size_t> count_known(const Neighbours& around, std::size_t count) {
  std::vector<std::size_t> known(count);
  for (std::size_t i = 0; i < count; ++i) {
    for (const std::uint32_t other : around.of(i)) ++known[other];
  }
  return known;
}

bool are_surface(const AllPlaces& places, const Neighbours& around,
                 const std::vector<std::size_t>& known, std::uint32_t point,
                 const std::vector<std::uint32_t>& coarser) {
  if (coarser.size() < least_count) return false;
  std::vector<double> thicknesses;
  std::size_t well_known = 0;
  for (const std::uint32_t other : coarser) {
    well_known += known[other] >= least_known;
    const auto all = around.of(other);
    thicknesses.push_back(
        thickness_around(places, other, all.first(std::min(closest_count, all.size()))));
  }
  return 2 * well_known > coarser.size() && thickness_around(places, point, coarser) <= thickest &&
         median(thicknesses) <= thickest;
}

}  // namespace

void add_coarser(const AllPlaces& places, Neighbours& around) {
  const std::vector<Coarser> found = find_coarser(places, around);
  const std::vector<std::size_t> known = count_known(around, places.size());
  for (auto at = found.begin(); at != found.end();) {
    const std::uint32_t point = at->point;
    std::vector<std::uint32_t> coarser;
    for (; at != found.end() && at->point == point; ++at) coarser.push_back(at->other);
    coarser.resize(std::min(coarser.size(), around.of(point).size() / 2));
    if (are_surface(places, around, known, point, coarser)) around.put_coarser(point, coarser);
  }
}

}  // namespace defray
