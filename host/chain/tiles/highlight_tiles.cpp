#include "chain/tiles/highlight_tiles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include "chain/tiles/tiles.h"
#include "kernels/params.h"
#include "lens/coc.h"

namespace defray {
namespace {

struct LightTile {
  std::int32_t largest_coc = 0;
  float darkest = HUGE_VALF;

  void add(const LightTile& other) { darkest = std::min(darkest, other.darkest); }
};

/// A tile that sees farther takes the darkest of the whole frame.
constexpr int farthest_tiles = 16;
constexpr int side = DEFRAY_HIGHLIGHT_TILE;

}  // namespace

int highlight_reach(std::int32_t coc_quanta) {
  // The disc, of three pixels at least, two pixels further out, and one for rounding.
  return std::max(std::abs(tame(coc_quanta)) / (1 << DEFRAY_COC_FRACTION_BITS) + 1, 3) + 3;
}

Values<float> darkest_around(const Frame& f, int light_channels) {
  const auto coc_quanta = f.coc_quanta.host();
  const auto coverage = f.coverage.host();
  std::vector<std::span<const float>> lights;
  for (std::size_t c = 0; c < size(light_channels); ++c) lights.push_back(f.channels[c].host());
  // A NaN counts as the darkest there is: such tiles are looked at.
  const auto look = [&](LightTile& tile, int x0, int y0, int x1, int y1) {
    const std::size_t count = size(x1 - x0);
    std::array<float, side> darkest{};
    darkest.fill(HUGE_VALF);
    std::int32_t largest = 0;
    for (int row = y0 * f.layers; row < y1 * f.layers; ++row) {
      const std::size_t first = size(row) * size(f.width) + size(x0);
      for (std::size_t k = 0; k < count; ++k) {
        const std::int32_t radius = std::abs(tame(coc_quanta[first + k]));
        largest = radius > largest ? radius : largest;
      }
      if (row % f.layers != 0) continue;  // not seen
      std::array<float, side> brightest{};
      brightest.fill(-HUGE_VALF);
      for (const auto& light : lights) {
        const float* const values = &light[first];
        for (std::size_t k = 0; k < count; ++k) {
          brightest[k] = values[k] > brightest[k] ? values[k] : brightest[k];
        }
      }
      for (std::size_t k = 0; k < count; ++k) {
        const float seen = coverage[first + k] < DEFRAY_SYNTHESISED ? brightest[k] : HUGE_VALF;
        darkest[k] = seen < darkest[k] ? seen : darkest[k];
      }
    }
    tile = {largest, *std::ranges::min_element(darkest)};
  };
  const Rows wanted = f.wanted_rows();
  const Rows known = wanted.with(highlight_reach(f.coc_range().largest_radius()), f.height);
  const Tiles<LightTile> tiles(f.width, f.height, known, side, look);
  const float darkest_of_all = tiles.all().darkest;
  std::vector<float> darkest(tiles.count());
  for (std::size_t t = tiles.first_of(wanted, side); t < tiles.end_of(wanted, side); ++t) {
    const int reach = highlight_reach(tiles[t].largest_coc) / side + 1;
    darkest[t] = reach > farthest_tiles ? darkest_of_all : tiles.around(t, reach).darkest;
  }
  return darkest;
}

}  // namespace defray
