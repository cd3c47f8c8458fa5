#include "splat/surfels/strays.h"

#include <algorithm>
#include <cmath>

#include "base/median.h"
#include "base/parallel.h"

namespace defray {
namespace {

/// Thickness of the surface around a point and the median of those around its neighbours: strays
/// all over a volume have 0.05 to 0.3 and at least 0.108, beside a surface down to 0.145 and 0.062;
/// the edges and corners of boxes up to 0.18 and 0.10, half of them 0.06 and 0.047. With these, 200
/// and 3000 strays before 115 000 points are dots, and a box 20 times coarser than what is beside
/// it has 0.5 to 2.5 % holes, at its edges; with a sum of 0.2 half as many, and a stray that hides
/// all.
constexpr double thickest_around = 0.1, thickest_sum = 0.18;
/// Where more than this share of the points around have it so many of their spacings above the
/// surface that they lie in, a point is not of that surface.
constexpr double farthest_above = 3, least_away = 0.1;
/// Likewise where most have it this much above.
constexpr double most_above = 1;

bool is_stray(const CloudPoints& cloud, const std::vector<EstimatedSurface>& surfaces,
              std::size_t point) {
  const auto around = cloud.around.alike(point);
  std::vector<double> thicknesses, heights;
  std::size_t away = 0;
  for (const std::uint32_t other : around) {
    const EstimatedSurface& there = surfaces[other];
    const double above = std::abs(dot(cloud.place(point) - there.middle, there.normal));
    heights.push_back(above / cloud.points[other].spacing);
    away += heights.back() > farthest_above;
    thicknesses.push_back(there.thickness);
  }
  const double of_others = median(thicknesses);
  return median(heights) > most_above || of_others > thickest_around ||
         of_others + surfaces[point].thickness > thickest_sum ||
         static_cast<double>(away) > least_away * static_cast<double>(around.size());
}

}  // namespace

std::vector<std::uint8_t> find_strays(const CloudPoints& cloud,
                                      const std::vector<std::uint8_t>& may_be) {
  std::vector<std::uint8_t> is_needed(may_be.size()), strays(may_be.size());
  for (std::size_t i = 0; i < may_be.size(); ++i) {
    if (!may_be[i]) continue;
    is_needed[i] = 1;
    for (const std::uint32_t other : cloud.around.of(i)) is_needed[other] = 1;
  }
  std::vector<EstimatedSurface> surfaces(may_be.size());
  parallel_for_each(may_be.size(), [&](std::size_t i) {
    if (is_needed[i]) surfaces[i] = estimate_surface(cloud, i);
  });
  parallel_for_each(may_be.size(),
                    [&](std::size_t i) { strays[i] = may_be[i] && is_stray(cloud, surfaces, i); });
  return strays;
}

}  // namespace defray
