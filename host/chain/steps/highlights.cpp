#include "chain/steps/highlights.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numbers>

#include "base/error.h"
#include "base/plane.h"
#include "chain/steps/hidden_lights.h"
#include "chain/steps/light_groups.h"
#include "lens/coc.h"

namespace defray {
namespace {

/// Calls visit(tile) for every tile that a source's disc may meet.
template <typename Visit>
void for_each_tile(const std::array<std::int32_t, 4>& where, int tiles_x, int tiles_y,
                   const Visit& visit) {
  constexpr int side = DEFRAY_LIGHT_TILE;
  const int reach = (std::abs(where[2]) >> DEFRAY_COC_FRACTION_BITS) + 2;
  const std::int64_t across = where[3] % DEFRAY_LIGHT_ROW, down = where[3] / DEFRAY_LIGHT_ROW;
  const auto tile = [](std::int64_t px, int count) {
    return static_cast<int>(std::clamp<std::int64_t>(px / side, 0, count - 1));
  };
  const std::int64_t x = where[0], y = where[1];
  for (int j = tile(y - reach, tiles_y); j <= tile(y + down - 1 + reach, tiles_y); ++j) {
    for (int i = tile(x - reach, tiles_x); i <= tile(x + across - 1 + reach, tiles_x); ++i) {
      visit(size(j) * size(tiles_x) + size(i));
    }
  }
}

/// Median alpha around a fragment's disc, where `highlights` looks for the light around it; its own
/// if all of that is beyond the frame.
float alpha_around(const Frame& f, std::span<const float> alpha, std::size_t own,
                   std::int32_t coc) {
  const int x = static_cast<int>(own % size(f.width));
  const int y = static_cast<int>(own / size(f.width) / size(f.layers));
  const float radius = std::fabs(static_cast<float>(coc)) * px_per_quantum;
  std::vector<float> around;
  for (int i = 0; i < 32; ++i) {
    const double distance = std::fmax(radius, 3.0f) * (i < 16 ? 0.5f : 1.0f) + 2.0f;
    const double angle = i % 16 * std::numbers::pi / 8;
    const double qx = x + std::rint(distance * std::cos(angle));
    const double qy = y + std::rint(distance * std::sin(angle));
    if (qx < 0 || qy < 0 || qx >= f.width || qy >= f.height) continue;
    around.push_back(alpha[f.index(static_cast<int>(qx), static_cast<int>(qy), 0)]);
  }
  if (around.empty()) return alpha[own];
  const auto middle = around.begin() + static_cast<std::ptrdiff_t>(around.size() / 2);
  std::nth_element(around.begin(), middle, around.end());
  return *middle;
}

/// An entry a pixel of a disc, up to a side of DEFRAY_LIGHT_MAP, of what something may hide.
/// Throws Error(input) where they are more than a place can say.
void place_maps(LightSources& lights, const std::vector<std::optional<std::int32_t>>& hiding) {
  constexpr std::size_t one = std::size_t{DEFRAY_LIGHT_MAP} * DEFRAY_LIGHT_MAP;
  for (std::size_t i = 0; i < lights.where.size(); ++i) {
    if (!hiding[i]) {
      lights.maps.push_back({});
      continue;
    }
    const auto& where = lights.where[i];
    if (lights.map_entries > std::numeric_limits<std::int32_t>::max() - one) {
      fail(ErrorKind::input,
           "{} highlights are too many so far out of focus: maps of what hides them take more than "
           "2 GiB; {} rays needs none",
           lights.where.size(), field("highlights"));
    }
    const std::int32_t radius_px = std::abs(where[2]) >> DEFRAY_COC_FRACTION_BITS;
    const std::int32_t side = std::min(2 * radius_px + 2, DEFRAY_LIGHT_MAP);
    lights.maps.push_back({static_cast<std::int32_t>(lights.map_entries), side, *hiding[i], 0});
    lights.map_entries += size(side) * size(side);
  }
}

}  // namespace

void take_light(Frame& f, const Values<float>& kept_share, const Values<float>& own_alpha,
                int light_channels, LightSources& lights) {
  const auto kept = kept_share.host(), alpha = own_alpha.host();
  const bool has_alpha = f.channels.size() > size(light_channels);
  std::vector<std::span<float>> channels;
  for (Values<float>& channel : f.channels) channels.push_back(channel.edit());
  const auto coc_quanta = f.coc_quanta.host();
  const auto coverage = f.coverage.host();
  const Rows wanted = f.wanted_rows();
  for (std::size_t i = f.index(0, wanted.y); i < f.index(0, wanted.end); ++i) {
    if (kept[i] == 1.0f) continue;
    const std::size_t row = i / size(f.width);
    const std::int32_t coc = tame(coc_quanta[i]);
    lights.where.push_back({static_cast<std::int32_t>(i % size(f.width)),
                            static_cast<std::int32_t>(row / size(f.layers)), coc,
                            1 + DEFRAY_LIGHT_ROW});
    std::array<float, 4> excess{};
    const float share = static_cast<float>(coverage[i] & ~DEFRAY_SYNTHESISED) / float{DEFRAY_WHOLE};
    for (std::size_t c = 0; c < size(light_channels); ++c) {
      const float base = channels[c][i] * kept[i];
      excess[c] = (channels[c][i] - base) * share;
      channels[c][i] = base;
    }
    // Alpha stays with the light: before nothing all of it, before what is opaque none.
    const float around = has_alpha ? alpha_around(f, alpha, i, coc) : 0;
    if (has_alpha && around < alpha[i]) {
      const float least = std::fmax(std::fmax(around, 0.0f), alpha[i] * kept[i]);
      excess[channels.size() - 1] = (alpha[i] - least) * share;
      channels.back()[i] = least;
    }
    std::fill(excess.begin() + static_cast<std::ptrdiff_t>(channels.size()), excess.end(),
              excess[channels.size() - 1]);
    lights.excess.push_back(excess);
  }
}

void show_through(const ApertureTable& aperture, LightSources& lights) {
  lights.table = aperture.sums;
  lights.share_of_light = 1.0f / static_cast<float>(aperture.total());
}

void sort_into_tiles(LightSources& lights, int width, int height) {
  lights.tiles_x = (width + DEFRAY_LIGHT_TILE - 1) / DEFRAY_LIGHT_TILE;
  const int tiles_y = (height + DEFRAY_LIGHT_TILE - 1) / DEFRAY_LIGHT_TILE;
  std::vector<std::vector<std::uint32_t>> tiles(size(lights.tiles_x) * size(tiles_y));
  for (std::uint32_t i = 0; i < lights.where.size(); ++i) {
    for_each_tile(lights.where[i], lights.tiles_x, tiles_y,
                  [&](std::size_t tile) { tiles[tile].push_back(i); });
  }
  lights.first.assign(1, 0);
  lights.list.clear();
  for (const auto& tile : tiles) {
    lights.list.insert(lights.list.end(), tile.begin(), tile.end());
    lights.first.push_back(static_cast<std::uint32_t>(lights.list.size()));
  }
}

LightSources lights_near(const LightSources& all, const Frame& f, int reach) {
  LightSources near;
  const Rows rows = f.wanted_rows().with(reach, f.height);
  for (std::size_t i = 0; i < all.where.size(); ++i) {
    if (all.where[i][1] < rows.y || all.where[i][1] >= rows.end) continue;
    near.where.push_back(all.where[i]);
    near.excess.push_back(all.excess[i]);
  }
  if (near.where.empty()) return near;
  group_lights(near);
  place_maps(near, find_hiding(near, f, rows));
  sort_into_tiles(near, f.width, f.height);
  near.table = all.table;
  near.share_of_light = all.share_of_light;
  return near;
}

LightSources take_light(Frame& f, const Values<float>& kept, int light_channels,
                        const ApertureTable& aperture) {
  LightSources lights;
  const Values<float>& alpha = f.channels.back();
  take_light(f, kept, std::vector<float>(alpha.begin(), alpha.end()), light_channels, lights);
  if (lights.where.empty()) return lights;
  show_through(aperture, lights);
  return lights_near(lights, f, f.height);
}

}  // namespace defray
