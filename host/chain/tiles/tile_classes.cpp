#include "chain/tiles/tile_classes.h"

#include <algorithm>
#include <cstdlib>

#include "base/parallel.h"
#include "lens/coc.h"

namespace defray {

/// is(i): of the frame's pixels, with the margin.
template <typename Is>
void TileClasses::add(TileClass tile_class, Rows rows, const Is& is) {
  const int first = std::max(rows.y - margin_, 0), end = std::min(rows.end - margin_, height_);
  if (first >= end) return;
  const int first_tile = first / side;
  parallel_for((end + side - 1) / side - first_tile, [&](int i) {
    const int tile_row = first_tile + i;
    for (int y = std::max(first, tile_row * side); y < std::min(end, (tile_row + 1) * side); ++y) {
      const std::size_t row = size(y + margin_) * size(width_ + 2 * margin_) + size(margin_);
      for (int x = 0; x < width_; ++x) {
        if (is(row + size(x))) at(x, y) = std::max(at(x, y), tile_class);
      }
    }
  });
}

TileClasses::TileClasses(const Frame& f)
    : width_(f.width - 2 * f.margin),
      height_(f.height - 2 * f.margin),
      margin_(f.margin),
      across_((width_ + side - 1) / side),
      tiles_(size(across_) * size((height_ + side - 1) / side)) {}

void TileClasses::add_surfaces(const Frame& f, const Words& flags) {
  const auto coc = f.coc_quanta.host();
  add(TileClass::smooth, f.wanted_rows(),
      [&](std::size_t i) { return std::abs(coc[i]) >= DEFRAY_SHARP_QUANTA; });
  const auto mixed = flags.host();
  add(TileClass::mixed, f.wanted_rows(), [&](std::size_t i) { return mixed[i] != 0; });
}

void TileClasses::add_hidden(const Values<float>& inverse, Rows rows) {
  const auto behind = inverse.host();
  add(TileClass::hidden, rows, [&](std::size_t i) { return behind[i] >= 0; });
}

void TileClasses::add(const LightSources& lights) {
  for (const auto& where : lights.where) {
    const int x = where[0] - margin_, y = where[1] - margin_;
    if (x >= 0 && y >= 0 && x < width_ && y < height_) at(x, y) = TileClass::lights;
  }
}

TileShares TileClasses::shares() const {
  const auto share = [&](TileClass c) {
    const auto count = std::count(tiles_.begin(), tiles_.end(), c);
    return static_cast<double>(count) / static_cast<double>(tiles_.size());
  };
  return {tiles_.size(),           share(TileClass::in_focus), share(TileClass::smooth),
          share(TileClass::mixed), share(TileClass::hidden),   share(TileClass::lights)};
}

void TileClasses::double_size(int width, int height) {
  width_ = width;
  height_ = height;
  zoom_ *= 2;
}

Plane TileClasses::picture() const {
  const int shown = side * zoom_;
  Plane out(size(width_) * size(height_));
  for (int y = 0; y < height_; ++y) {
    for (int x = 0; x < width_; ++x) {
      const TileClass tile = tiles_[size(y / shown) * size(across_) + size(x / shown)];
      out[size(y) * size(width_) + size(x)] = static_cast<float>(tile);
    }
  }
  return out;
}

}  // namespace defray
