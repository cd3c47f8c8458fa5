#include "chain/steps/hidden_lights.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "base/parallel.h"
#include "base/plane.h"
#include "chain/tiles/tiles.h"
#include "kernels/params.h"
#include "lens/coc.h"

namespace defray {
namespace {

constexpr int tile_side = 16;

/// A way of `light_maps` is at C - t or farther from the lens t px from a source with the radius C,
/// and meets what is up to half a step nearer or farther, after rounding to pixels: all of that is
/// less than this.
constexpr float slack_px = 2;
/// What hides between two pixels was nearer than the way in the first of them, a step from the
/// source at least: so that is found.
static_assert(DEFRAY_JUMP_QUANTA <= 1 << DEFRAY_COC_FRACTION_BITS);

float radius_px(std::int32_t quanta) { return static_cast<float>(quanta) * px_per_quantum; }

/// A source, and what would hide it.
struct Source {
  float x, y, coc;

  explicit Source(const std::array<std::int32_t, 4>& where)
      : x(static_cast<float>(where[0]) +
          0.5f * static_cast<float>(where[3] % DEFRAY_LIGHT_ROW - 1)),
        y(static_cast<float>(where[1]) +
          0.5f * static_cast<float>(where[3] / DEFRAY_LIGHT_ROW - 1)),
        coc(radius_px(where[2])) {}

  bool is_in_front(float other) const { return other < coc - radius_px(DEFRAY_JUMP_QUANTA); }

  /// Whether what has this radius, so far away along each axis, may be met by a way.
  bool may_meet(float other, float dx, float dy) const {
    const float farthest = coc - other + slack_px;
    return is_in_front(other) && dx * dx + dy * dy <= farthest * farthest;
  }
};

/// A tile's pixels, and the nearest radius among them.
struct NearestTile {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  std::int32_t least = std::numeric_limits<std::int32_t>::max();

  void add(const NearestTile& other) { least = std::min(least, other.least); }

  /// Of the nearest of its pixels along each axis.
  bool may_hide(const Source& s) const {
    const auto beyond = [](float at, int first, int end) {
      return std::max({static_cast<float>(first) - at, at - static_cast<float>(end - 1), 0.0f});
    };
    return s.may_meet(radius_px(least), beyond(s.x, x0, x1), beyond(s.y, y0, y1));
  }
};

/// What may hide sources in some rows of a frame.
class Hiding {
 public:
  Hiding(const Frame& frame, Rows rows)
      : frame_(frame),
        coc_(frame.coc_quanta.host()),
        rows_(rows),
        tiles_(frame.width, frame.height, rows, tile_side,
               [this](NearestTile& tile, int x0, int y0, int x1, int y1) {
                 tile = {x0, y0, x1, y1};
                 any_pixel(tile, [&](int x, int y) {
                   tile.least = std::min(tile.least, coc_at(x, y));
                   return false;
                 });
               }),
        least_(radius_px(tiles_.all().least)) {}

  /// The least radius in tiles that hold some that may hide a source.
  std::optional<std::int32_t> least(const Source& s) const {
    std::int32_t least = std::numeric_limits<std::int32_t>::max();
    bool is_hidden = false;
    const float reach = s.coc - least_ + slack_px;
    const int across = (frame_.width + tile_side - 1) / tile_side;
    for (int j = tile_at(s.y - reach, rows_); j <= tile_at(s.y + reach, rows_); ++j) {
      for (int i = tile_at(s.x - reach, columns()); i <= tile_at(s.x + reach, columns()); ++i) {
        const NearestTile& tile = tiles_[size(j) * size(across) + size(i)];
        if (!tile.may_hide(s)) continue;
        least = std::min(least, tile.least);
        is_hidden = is_hidden || any_pixel(tile, [&](int x, int y) {
                      return s.may_meet(radius_px(coc_at(x, y)), static_cast<float>(x) - s.x,
                                        static_cast<float>(y) - s.y);
                    });
      }
    }
    return is_hidden ? std::optional(least) : std::nullopt;
  }

 private:
  Rows columns() const { return {0, frame_.width}; }

  /// The tile of a pixel or, beyond the first or last of these, of that.
  static int tile_at(float place, Rows within) {
    return static_cast<int>(std::clamp(place, static_cast<float>(within.y),
                                       static_cast<float>(within.end - 1))) /
           tile_side;
  }

  std::int32_t coc_at(int x, int y) const { return tame(coc_[frame_.index(x, y)]); }

  template <typename Visit>
  static bool any_pixel(const NearestTile& tile, const Visit& visit) {
    for (int y = tile.y0; y < tile.y1; ++y) {
      for (int x = tile.x0; x < tile.x1; ++x) {
        if (visit(x, y)) return true;
      }
    }
    return false;
  }

  const Frame& frame_;
  const std::span<const std::int32_t> coc_;
  const Rows rows_;
  const Tiles<NearestTile> tiles_;
  const float least_;
};

}  // namespace

std::vector<std::optional<std::int32_t>> find_hiding(const LightSources& lights, const Frame& frame,
                                                     Rows rows) {
  const Hiding hiding(frame, rows);
  std::vector<std::optional<std::int32_t>> least(lights.where.size());
  parallel_for(static_cast<int>(least.size()),
               [&](int i) { least[size(i)] = hiding.least(Source(lights.where[size(i)])); });
  return least;
}

}  // namespace defray
