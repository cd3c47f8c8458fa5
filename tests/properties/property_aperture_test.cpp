// Whatever the aperture: light in boxes adds up, and samples stay where light is.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>

#include "lens/aperture_table.h"
#include "lens/lens_points.h"

namespace defray::test::property_aperture_test {
namespace {

/// Any coverage, mostly dark, never black.
ApertureMask any_mask() {
  ApertureMask mask;
  std::uint32_t state = *rc::gen::inRange<std::uint32_t>(1, 1u << 30);
  for (int i = 0; i < ApertureMask::side * ApertureMask::side; ++i) {
    state = state * 1664525u + 1013904223u;
    mask.coverage.push_back((state >> 30) ? 0 : static_cast<std::uint8_t>(state >> 22));
  }
  mask.coverage[*rc::gen::inRange<std::size_t>(0, mask.coverage.size())] = 255;
  return mask;
}

/// Cuts of the square and somewhat more, in order, its sides included.
std::vector<std::int32_t> any_cuts() {
  auto cuts = *rc::gen::container<std::vector<std::int32_t>>(rc::gen::inRange(-65536, 65537));
  cuts.insert(cuts.end(), {-65536, 65536, -80000, 80000});
  std::sort(cuts.begin(), cuts.end());
  return cuts;
}

RC_GTEST_PROP(ApertureProperty, BoxesThatTileTheSquareHoldAllLight, ()) {
  const ApertureTable table = make_aperture_table(any_mask());
  const auto columns = any_cuts(), rows = any_cuts();
  std::uint64_t sum = 0;
  for (std::size_t j = 0; j + 1 < rows.size(); ++j) {
    for (std::size_t i = 0; i + 1 < columns.size(); ++i) {
      sum += light_in_box(table, columns[i], rows[j], columns[i + 1], rows[j + 1]);
    }
  }
  RC_ASSERT(sum == table.total());
}

/// Length of [a, b) within texel i, in 1/256 texel.
std::uint64_t overlap(std::int32_t a, std::int32_t b, int i) {
  const std::int32_t begin = std::max(a + 65536, i * 256), end = std::min(b + 65536, i * 256 + 256);
  return static_cast<std::uint64_t>(std::max(0, end - begin));
}

RC_GTEST_PROP(ApertureProperty, ABoxHoldsItsPartOfEachTexel, ()) {
  const ApertureMask mask = any_mask();
  const auto u0 = *rc::gen::inRange(-70000, 70000), v0 = *rc::gen::inRange(-70000, 70000);
  const auto u1 = u0 + *rc::gen::inRange(-10, 5000), v1 = v0 + *rc::gen::inRange(-10, 5000);
  std::uint64_t sum = 0;
  for (int row = 0; row < ApertureMask::side; ++row) {
    for (int column = 0; column < ApertureMask::side; ++column) {
      sum += overlap(u0, u1, column) * overlap(v0, v1, row) * mask.at(column, row);
    }
  }
  RC_ASSERT(light_in_box(make_aperture_table(mask), u0, v0, u1, v1) == sum);
}

RC_GTEST_PROP(ApertureProperty, SamplesOfBladesStayInTheDisc, ()) {
  Aperture a;
  a.blades = *rc::gen::element(0, 3, 4, 5, 6, 7, 11, 32);
  if (a.blades) {
    a.curvature = *rc::gen::inRange(a.blades == 3 ? 0 : -100, 101) / 100.0;
    a.rotation_deg = *rc::gen::inRange(-1000, 1000);
  }
  a.squeeze = *rc::gen::inRange(1, 65) / 8.0;
  const int count = *rc::gen::inRange(1, 600);
  const LensPoints lens = make_lens_points(a, count);
  RC_ASSERT(lens.points.size() == static_cast<std::size_t>(count));
  for (const auto& [u, v] : lens.points) RC_ASSERT(std::hypot(u, v) <= 65536);
}

}  // namespace
}  // namespace defray::test::property_aperture_test
