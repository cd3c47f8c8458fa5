#include "lens/aperture_table.h"

#include <algorithm>

#include "kernels/params.h"

namespace defray {
namespace {

constexpr int fraction_bits = 8;
constexpr std::int32_t lens_radius = 1 << DEFRAY_LENS_FRACTION_BITS;
static_assert(ApertureMask::side << fraction_bits == 2 * lens_radius);

/// A lens coordinate in 1/256 texel from the table's first edge.
std::uint32_t to_table(std::int32_t lens) {
  return static_cast<std::uint32_t>(std::clamp(lens, -lens_radius, lens_radius) + lens_radius);
}

/// Light above and to the left of a point.
std::uint64_t light_before(const ApertureTable& table, std::uint32_t u, std::uint32_t v) {
  const std::uint32_t column = u >> fraction_bits, row = v >> fraction_bits;
  const std::uint64_t right = u & 255, below = v & 255;
  // On the last edge the next entry, which is not there, has weight 0.
  const std::uint32_t next_column = column + (right ? 1 : 0), next_row = row + (below ? 1 : 0);
  const auto sum = [&](std::uint32_t r, std::uint32_t c) -> std::uint64_t {
    return table.sums[r * ApertureTable::side + c];
  };
  return (256 - below) * ((256 - right) * sum(row, column) + right * sum(row, next_column)) +
         below * ((256 - right) * sum(next_row, column) + right * sum(next_row, next_column));
}

}  // namespace

ApertureTable make_aperture_table(const ApertureMask& mask) {
  constexpr auto side = static_cast<std::size_t>(ApertureTable::side);
  ApertureTable table{std::vector<std::uint32_t>(side * side)};
  for (std::size_t row = 1; row < side; ++row) {
    std::uint32_t of_row = 0;
    for (std::size_t column = 1; column < side; ++column) {
      of_row += mask.at(static_cast<int>(column) - 1, static_cast<int>(row) - 1);
      table.sums[row * side + column] = table.sums[(row - 1) * side + column] + of_row;
    }
  }
  return table;
}

std::uint64_t light_in_box(const ApertureTable& table, std::int32_t u0, std::int32_t v0,
                           std::int32_t u1, std::int32_t v1) {
  if (u0 >= u1 || v0 >= v1) return 0;
  const std::uint32_t left = to_table(u0), right = to_table(u1);
  const std::uint32_t top = to_table(v0), bottom = to_table(v1);
  return light_before(table, right, bottom) - light_before(table, left, bottom) -
         light_before(table, right, top) + light_before(table, left, top);
}

}  // namespace defray
