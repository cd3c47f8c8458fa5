#pragma once
// What a frame's tiles hold: what each costs, and where an error may lie.
#include "defray/report.h"
#include "frame/frame.h"
#include "rdb/light_sources.h"

namespace defray {

/// For each tile what is in it, the picture alone; of all that is in a tile the last of these.
enum class TileClass : std::uint8_t {
  in_focus,  ///< Every CoC below half a pixel.
  smooth,    ///< One surface, or several that the lens does not part.
  mixed,     ///< Mixed pixels.
  hidden,    ///< A made-up surface behind.
  lights,    ///< Highlights that became discs.
};

class TileClasses {
 public:
  TileClasses() = default;
  /// Of a frame with its margin; all in focus.
  explicit TileClasses(const Frame& frame);

  /// The frame's wanted rows; `mixed` is 1 where pixels are.
  void add_surfaces(const Frame& frame, const Words& mixed);
  /// Where 1/depth is not negative, with the margin.
  void add_hidden(const Values<float>& inverse, Rows rows);
  void add(const LightSources& lights);

  /// The same tiles of a frame twice as large, of `width` x `height`.
  void double_size(int width, int height);

  /// In all, and of each class.
  TileShares shares() const;

  /// The number of each pixel's tile's class.
  Plane picture() const;

 private:
  TileClass& at(int x, int y) { return tiles_[size(y / side) * size(across_) + size(x / side)]; }
  template <typename Is>
  void add(TileClass tile_class, Rows rows, const Is& is);

  static constexpr int side = 16;
  int width_ = 0, height_ = 0, margin_ = 0, across_ = 0, zoom_ = 1;
  std::vector<TileClass> tiles_;
};

}  // namespace defray
