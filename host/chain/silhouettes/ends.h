#pragma once
// Where silhouettes end at what hides them.
#include <cstdint>
#include <limits>
#include <vector>

#include "frame/frame.h"
#include "lens/coc.h"

namespace defray {

/// Surfaces up to so many pixels wide are thin: their two silhouettes go on together. (`lines`,
/// 640x480: 39.94 dB for 5, 40.00 for 6, 39.98 for 8, 39.70 where nothing is thin.)
inline constexpr int thin_px = 6;

/// How far a silhouette goes on, where the lens looks so far.
inline constexpr int longest_px = 64;

/// Whether one CoC is farther than another by more than a surface's own slant, or neither is.
inline bool is_jump(std::int32_t near, std::int32_t far) { return far - near > DEFRAY_JUMP_QUANTA; }
inline bool is_same(std::int32_t a, std::int32_t b) { return !is_jump(a, b) && !is_jump(b, a); }

/// A pixel, or a corner of pixels: that at the upper left of the pixel.
struct Corner {
  int x, y;
};

/// CoC radii of a frame; beyond its edges those of the nearest pixels.
class CocAround {
 public:
  explicit CocAround(const Frame& f) : f_(f), coc_quanta_(f.coc_quanta.host()) {}
  std::int32_t operator()(Corner pixel) const {
    return tame(coc_quanta_[f_.index_within(pixel.x, pixel.y)]);
  }

 private:
  const Frame& f_;
  std::span<const std::int32_t> coc_quanta_;
};

/// The end of the edge between two surfaces at a third one in front of both, and how it goes on.
struct SilhouetteEnd {
  Corner at;
  std::int32_t coc;             ///< Of the nearer of the two: it is that one's silhouette.
  double px;                    ///< As far as it goes on.
  double x, y;                  ///< From here: on the straight line of the edge.
  double along_x, along_y;      ///< Where to, a unit vector, and
  double inwards_x, inwards_y;  ///< where its own surface lies.
  double wide_px;               ///< That surface; infinity: not thin.

  bool is_thin() const { return wide_px < std::numeric_limits<double>::infinity(); }

  Corner pixel(double along_px, double inwards_px) const;
};

/// Rows around an end that are looked at.
int silhouette_end_rows();

/// Those at corners in some rows, from the top. There are some at mixed pixels alone.
std::vector<SilhouetteEnd> silhouette_ends(const Frame& front, const Words& mixed, Rows rows);

}  // namespace defray
