#pragma once
// Where depth was anti-aliased.
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "frame/band_rows.h"

namespace defray {

/// Anti-aliased depth is wrong where a pixel holds two surfaces, and its colour is a mean of theirs
/// in the same shares. Thin things that truly lie between two others, grass, rings, rims, look the
/// same in depth, but have colours of their own. A single pixel's colour says little (texture);
/// those of the pixels around and of the whole frame together say which it is.
class Antialiased {
 public:
  Antialiased(int width, int height);

  /// Rows of what `repair` says, of a plane [height][width]; each row once.
  void add(Rows rows, std::span<const std::uint32_t> ramps);

  /// Of all rows, which have so many mixed pixels; once.
  void decide(std::size_t mixed);

  /// Once it is decided: of pixels between two surfaces, whether they are to be repaired, and how
  /// many they are.
  bool is_at(std::size_t x, std::size_t y) const { return cells_[cell(x, y)].is_antialiased; }
  std::size_t pixels() const { return pixels_; }

 private:
  struct Cell {
    std::size_t ramps = 0, means = 0;  ///< Pixels between two surfaces; those of mean colours.
    bool is_antialiased = false;
  };
  std::size_t cell(std::size_t x, std::size_t y) const;
  Cell around(std::size_t x, std::size_t y) const;

  std::size_t width_, columns_, rows_;
  std::vector<Cell> cells_;
  std::size_t pixels_ = 0;
};

}  // namespace defray
