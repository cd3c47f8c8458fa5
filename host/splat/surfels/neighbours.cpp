#include "splat/surfels/neighbours.h"

#include <algorithm>
#include <compare>
#include <nanoflann.hpp>
#include <utility>

#include "base/parallel.h"
#include "base/vec3.h"

namespace defray {
namespace {

/// Places as nanoflann asks for them.
struct Places {
  const std::vector<std::array<float, 3>>& all;

  Vec3 from_to(std::size_t from, std::size_t to) const {
    const auto &a = all[from], &b = all[to];
    return Vec3{b[0], b[1], b[2]} - Vec3{a[0], a[1], a[2]};
  }
  std::size_t kdtree_get_point_count() const { return all.size(); }
  float kdtree_get_pt(std::uint32_t point, std::size_t axis) const { return all[point][axis]; }
  template <typename Box>
  bool kdtree_get_bbox(Box& /*box*/) const {
    return false;  // it finds one itself
  }
};

using Index = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, Places>,
                                                  Places, 3, std::uint32_t>;

/// The nearest `count` to a point, itself left out.
void find_nearest(const Index& index, const Places& places, std::uint32_t point,
                  std::span<std::uint32_t> out) {
  std::vector<std::uint32_t> indices(out.size() + 1);
  std::vector<float> squares(out.size() + 1);
  index.knnSearch(places.all[point].data(), indices.size(), indices.data(), squares.data());
  std::vector<std::pair<float, std::uint32_t>> nearest;
  for (std::size_t i = 0; i < indices.size(); ++i) {
    if (indices[i] != point) nearest.emplace_back(squares[i], indices[i]);
  }
  std::sort(nearest.begin(), nearest.end());
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = nearest[i].second;
}

/// From here on the directions in which others lie, their mean, are all to one side: of half a disc
/// it is 0.64, of random ones around a point 0.2.
constexpr double one_sided = 0.5;
/// The other side is where directions have this cosine to theirs or less.
constexpr double other_side = -0.3;
/// Coarser ones' neighbours reach farther than the point's by this: of random points some reach 1.2
/// times as far as those beside them, at a face with points three times as near 1.25.
constexpr double coarser_reach = 1.25;

/// The mean direction of the points around each that has them all on one side; else 0.
std::vector<Vec3> find_one_sided(const Places& places, const Neighbours& around) {
  std::vector<Vec3> sides(places.all.size());
  parallel_for_each(sides.size(), [&](std::size_t i) {
    Vec3 sum{};
    for (const std::uint32_t other : around.of(i)) {
      const Vec3 d = places.from_to(i, other);
      if (dot(d, d) > 0) sum = sum + normalized(d);
    }
    const Vec3 mean = sum / static_cast<double>(std::max<std::size_t>(around.of(i).size(), 1));
    if (length(mean) > one_sided) sides[i] = mean;
  });
  return sides;
}

/// One that has a point around it, which has others on the other side alone.
struct Coarser {
  std::uint32_t point;
  float square;  ///< Of their distance.
  std::uint32_t other;

  auto operator<=>(const Coarser&) const = default;
};

/// All of them, each point's nearest first.
std::vector<Coarser> find_coarser(const Places& places, const Neighbours& around) {
  const std::vector<Vec3> sides = find_one_sided(places, around);
  std::vector<Coarser> found;
  const auto reach = [&](std::uint32_t point) {
    return length(places.from_to(point, around.of(point).back()));
  };
  for (std::uint32_t other = 0; other < places.all.size(); ++other) {
    for (const std::uint32_t point : around.of(other)) {
      const Vec3 d = places.from_to(point, other);
      if (!(dot(d, sides[point]) < other_side * length(d) * length(sides[point]))) continue;
      if (!(reach(other) > coarser_reach * reach(point))) continue;
      const auto known = around.of(point);
      if (std::find(known.begin(), known.end(), other) != known.end()) continue;
      found.push_back({point, static_cast<float>(dot(d, d)), other});
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace

Neighbours::Neighbours(const std::vector<std::array<float, 3>>& places, std::size_t most)
    : count_(std::min(most, places.size() - 1)),
      all_(count_ * places.size()),
      coarser_(places.size()) {
  const Places points{places};
  const Index index(3, points);
  parallel_for_each(places.size(), [&](std::size_t i) {
    find_nearest(index, points, static_cast<std::uint32_t>(i), {all_.data() + i * count_, count_});
  });
  for (const Coarser& c : find_coarser(points, *this)) {
    if (coarser_[c.point] == count_ / 2) continue;
    const auto end = all_.begin() + static_cast<std::ptrdiff_t>((c.point + 1) * count_);
    const auto first = end - coarser_[c.point]++;
    std::copy(first, end, first - 1);
    *(end - 1) = c.other;
  }
}

}  // namespace defray
