#include "chain/steps/light_groups.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <unordered_map>

#include "base/plane.h"
#include "kernels/params.h"

namespace defray {
namespace {

/// CoC radii from which two and four pixels a side are one source.
constexpr std::int32_t two_from = 12 << DEFRAY_COC_FRACTION_BITS;
constexpr std::int32_t four_from = 48 << DEFRAY_COC_FRACTION_BITS;
/// What the first of a source and another differ by at most: in CoC, an eighth of a pixel for each
/// of its side; in light of any channel, a fifth of the brighter one's, as light that is spread
/// evenly moves towards the fainter. On `garden` post (480x300) sources of any light lose 0.21 dB,
/// of half the light 0.07, these 0.01; CoCs twice or half as far apart change that by 0.01.
constexpr std::int32_t quanta_a_side = (1 << DEFRAY_COC_FRACTION_BITS) / 8;
constexpr float share_of_light = 0.2f;

int side_of(std::int32_t coc) {
  const std::int32_t radius = std::abs(coc);
  return radius < two_from ? 1 : radius < four_from ? 2 : DEFRAY_LIGHT_GROUP;
}

using Light = std::array<float, 4>;

/// Whether lights are alike in all channels; what is not finite is like nothing.
bool is_alike(const Light& a, const Light& b) {
  const float most = share_of_light * std::max(std::ranges::max(a), std::ranges::max(b));
  return std::ranges::equal(a, b, [&](float x, float y) { return std::fabs(x - y) < most; });
}

/// Pixels of a square, so far.
struct Group {
  std::int32_t left, top, right, bottom, first_coc;
  std::int64_t coc_sum, count;
  Light first_light, light;

  void add(const std::array<std::int32_t, 4>& where, const Light& excess) {
    left = std::min(left, where[0]);
    top = std::min(top, where[1]);
    right = std::max(right, where[0]);
    bottom = std::max(bottom, where[1]);
    coc_sum += where[2];
    ++count;
    for (std::size_t c = 0; c < 4; ++c) light[c] += excess[c];
  }
};

/// The squares' groups, in the order of their first pixels.
class Groups {
 public:
  void add(const std::array<std::int32_t, 4>& where, const Light& excess) {
    const std::int32_t coc = where[2];
    const int side = side_of(coc);
    const std::int64_t square = (std::int64_t{where[1] / side} << 32) + where[0] / side;
    std::vector<std::size_t>& here = squares_[square * DEFRAY_LIGHT_GROUP + side - 1];
    for (const std::size_t i : here) {
      Group& group = groups_[i];
      const bool is_near = std::abs(coc - group.first_coc) <= side * quanta_a_side;
      if (is_near && is_alike(group.first_light, excess)) return group.add(where, excess);
    }
    here.push_back(groups_.size());
    groups_.push_back({where[0], where[1], where[0], where[1], coc, coc, 1, excess, excess});
  }

  const std::vector<Group>& all() const { return groups_; }

 private:
  std::vector<Group> groups_;
  std::unordered_map<std::int64_t, std::vector<std::size_t>> squares_;
};

}  // namespace

void group_lights(LightSources& lights) {
  Groups groups;
  for (std::size_t i = 0; i < lights.where.size(); ++i) {
    groups.add(lights.where[i], lights.excess[i]);
  }
  lights.where.clear();
  lights.excess.clear();
  for (const Group& g : groups.all()) {
    const std::int32_t across = g.right - g.left + 1, down = g.bottom - g.top + 1;
    const auto coc = static_cast<std::int32_t>(g.coc_sum / g.count);
    lights.where.push_back({g.left, g.top, coc, across + DEFRAY_LIGHT_ROW * down});
    lights.excess.push_back(g.light);
    for (float& light : lights.excess.back()) light /= static_cast<float>(across * down);
  }
}

}  // namespace defray
