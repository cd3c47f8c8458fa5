#include "chain/steps/hidden_lights.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "base/parallel.h"
#include "base/plane.h"
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

/// The nearest radii of a frame's tiles.
class NearestTiles {
 public:
  NearestTiles(const Frame& frame, Rows rows)
      : frame_(frame),
        coc_(frame.coc_quanta.host()),
        rows_(rows),
        across_((frame.width + tile_side - 1) / tile_side),
        down_((rows.count() + tile_side - 1) / tile_side),
        least_(size(across_) * size(down_)) {
    parallel_for(down_, [&](int j) { find_least(j); });
    least_of_all_ = *std::ranges::min_element(least_);
  }

  bool may_hide(const Source& s) const {
    const float reach = s.coc - least_of_all_ + slack_px;
    const float top = s.y - static_cast<float>(rows_.y);
    for (int j = tile_of(top - reach, down_); j <= tile_of(top + reach, down_); ++j) {
      for (int i = tile_of(s.x - reach, across_); i <= tile_of(s.x + reach, across_); ++i) {
        if (may_hide_in_tile(s, i, j)) return true;
      }
    }
    return false;
  }

 private:
  static int tile_of(float place, int count) {
    return static_cast<int>(
        std::clamp(std::floor(place / tile_side), 0.0f, static_cast<float>(count - 1)));
  }

  /// Pixels first to last of a tile's row or column.
  static std::array<int, 2> span_of(int tile, int from, int end) {
    const int first = from + tile * tile_side;
    return {first, std::min(first + tile_side, end) - 1};
  }

  float coc_at(int x, int y) const { return radius_px(tame(coc_[frame_.index(x, y)])); }

  template <typename Visit>
  bool any_in_tile(int i, int j, const Visit& visit) const {
    const auto [left, right] = span_of(i, 0, frame_.width);
    const auto [top, bottom] = span_of(j, rows_.y, rows_.end);
    for (int y = top; y <= bottom; ++y) {
      for (int x = left; x <= right; ++x) {
        if (visit(x, y)) return true;
      }
    }
    return false;
  }

  void find_least(int j) {
    for (int i = 0; i < across_; ++i) {
      float least = std::numeric_limits<float>::infinity();
      any_in_tile(i, j, [&](int x, int y) {
        least = std::min(least, coc_at(x, y));
        return false;
      });
      least_[size(j) * size(across_) + size(i)] = least;
    }
  }

  bool may_hide_in_tile(const Source& s, int i, int j) const {
    const auto [left, right] = span_of(i, 0, frame_.width);
    const auto [top, bottom] = span_of(j, rows_.y, rows_.end);
    const auto beyond = [](float at, int first, int last) {
      return std::max({static_cast<float>(first) - at, at - static_cast<float>(last), 0.0f});
    };
    const float least = least_[size(j) * size(across_) + size(i)];
    if (!s.may_meet(least, beyond(s.x, left, right), beyond(s.y, top, bottom))) return false;
    return any_in_tile(i, j, [&](int x, int y) {
      return s.may_meet(coc_at(x, y), static_cast<float>(x) - s.x, static_cast<float>(y) - s.y);
    });
  }

  const Frame& frame_;
  const std::span<const std::int32_t> coc_;
  const Rows rows_;
  const int across_, down_;
  std::vector<float> least_;  ///< [down][across]
  float least_of_all_ = 0;
};

}  // namespace

std::vector<char> find_hidden_lights(const LightSources& lights, const Frame& frame, Rows rows) {
  const NearestTiles tiles(frame, rows);
  std::vector<char> hidden(lights.where.size());
  parallel_for(static_cast<int>(hidden.size()),
               [&](int i) { hidden[size(i)] = tiles.may_hide(Source(lights.where[size(i)])); });
  return hidden;
}

}  // namespace defray
