#include "rdb/segments.h"

#include <algorithm>
#include <cstdlib>
#include <limits>

#include "base/plane.h"
#include "lens/landing_radii.h"

namespace defray {
namespace {

constexpr int ray_bits = DEFRAY_COC_FRACTION_BITS + DEFRAY_LENS_FRACTION_BITS;
constexpr std::int64_t half_pixel = std::int64_t{1} << (ray_bits - 1);
constexpr std::int64_t never = std::numeric_limits<std::int64_t>::max();

std::int64_t floor_of(std::int64_t a, std::int64_t b) {
  return a / b - (a % b != 0 && (a < 0) != (b < 0) ? 1 : 0);
}

/// One axis of a lens point: rays of radius r land `landing` px away, the one d with
/// d - r u in [-1/2, 1/2).
struct Axis {
  std::int64_t u;

  std::int64_t landing(std::int64_t r) const { return (r * u + half_pixel - 1) >> ray_bits; }

  /// The first radius that lands elsewhere than r, and than those between.
  std::int64_t next(std::int64_t r) const {
    const std::int64_t d = landing(r);
    // d + 1 begins where r u >= ((d + 1) << bits) - half + 1; d ends where r u <= (d << bits) -
    // half.
    if (u > 0) return floor_of(((d + 1) << ray_bits) - half_pixel, u) + 1;
    if (u < 0) return floor_of(half_pixel - 1 - (d << ray_bits), -u) + 1;
    return never;
  }

  /// The radii that land less than `side` px away, and a few more at most.
  std::int64_t limit(int side) const {
    return u == 0 ? never : ((std::int64_t{side} << ray_bits) / std::abs(u)) + 1;
  }
};

void add_cell(const LensPoints& lens, const Axis& x, const Axis& y, std::int64_t least,
              std::int64_t largest, int width, int height, std::vector<Segment>& segments) {
  const std::int64_t limit = std::min(x.limit(width), y.limit(height));
  const std::int64_t end = limit == never ? largest : std::min(largest, limit);
  std::int64_t r = limit == never ? least : std::max(least, -limit);
  while (r <= end) {
    const std::int64_t as = landing_radius(lens, r), dx = x.landing(as), dy = y.landing(as);
    const std::int64_t next = first_landing_as(lens, std::min(x.next(as), y.next(as)));
    const std::int64_t last = std::min(next, largest + 1) - 1;
    if (std::abs(dx) < width && std::abs(dy) < height) {
      segments.push_back({static_cast<std::int32_t>(dx), static_cast<std::int32_t>(dy),
                          static_cast<std::int32_t>(r), static_cast<std::int32_t>(last - r)});
    }
    r = last + 1;
  }
}

}  // namespace

RadiusBins::RadiusBins(std::int32_t from, std::int32_t to, int longest_side_px)
    : least(from), largest(to) {
  const std::int64_t most = std::int64_t{longest_side_px} << DEFRAY_COC_FRACTION_BITS;
  const std::int64_t lo = std::max<std::int64_t>(least, -most);
  const std::int64_t hi = std::max<std::int64_t>(lo, std::min<std::int64_t>(largest, most));
  while ((hi >> shift) - (lo >> shift) >= DEFRAY_RAY_BINS) ++shift;
  first_bin = static_cast<int>(lo >> shift);
}

std::int64_t RadiusBins::first_radius(int bin) const {
  const std::int64_t from = (std::int64_t{first_bin} + bin) << shift;
  return bin == 0 ? std::min<std::int64_t>(from, least) : from;
}

std::int64_t RadiusBins::largest_of(int bin) const {
  const bool is_last = bin == DEFRAY_RAY_BINS - 1;
  const std::int64_t end = first_radius(bin + 1) - 1;
  const std::int64_t last = is_last ? std::max<std::int64_t>(end, largest) : end;
  return std::max(std::abs(first_radius(bin)), std::abs(last));
}

SegmentTable::SegmentTable(const LensPoints& lens, int first_cell, const RadiusBins& bins,
                           int width, int height, std::size_t most) {
  for (std::size_t cell = size(first_cell); cell < lens.points.size(); ++cell) {
    const auto [u, v] = lens.points[cell];
    std::size_t at = segments.size();
    add_cell(lens, {u}, {v}, bins.least, bins.largest, width, height, segments);
    const std::size_t runs = first.size() / 2;
    if (segments.size() + runs > most && !first.empty()) {
      segments.resize(at);
      return;
    }
    for (int b = 0; b < DEFRAY_RAY_BINS; ++b) {
      const auto ends_before = [&](const Segment& s) {
        return std::int64_t{s[2]} + static_cast<std::uint32_t>(s[3]) < bins.first_radius(b);
      };
      while (at < segments.size() && ends_before(segments[at])) ++at;
      first.push_back(static_cast<std::int32_t>(at));
    }
    first.push_back(static_cast<std::int32_t>(segments.size()));
  }
}

}  // namespace defray
