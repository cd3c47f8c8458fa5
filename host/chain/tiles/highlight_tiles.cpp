#include "chain/tiles/highlight_tiles.h"

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
  const auto look = [&](LightTile& tile, int x0, int y0, int x1, int y1) {
    for (int row = y0 * f.layers; row < y1 * f.layers; ++row) {
      for (int x = x0; x < x1; ++x) {
        const std::size_t i = size(row) * size(f.width) + size(x);
        tile.largest_coc = std::max(tile.largest_coc, std::abs(tame(coc_quanta[i])));
        const bool is_seen = row % f.layers == 0 && coverage[i] < DEFRAY_SYNTHESISED;
        if (!is_seen) continue;
        float light = lights[0][i];
        for (const auto& channel : lights) light = std::fmax(light, channel[i]);
        tile.darkest = std::fmin(tile.darkest, light);
      }
    }
  };
  constexpr int side = DEFRAY_HIGHLIGHT_TILE;
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
