#pragma once
// What lies behind, continued from elsewhere in the picture: repeating surfaces look alike at a few
// shifts (He & Sun 2012, "Statistics of patch offsets for image completion"). Where the
// surroundings of a hidden pixel agree with those of its shifted selves, their colours replace the
// smooth one, by as much as the agreement explains.
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "defray/options.h"
#include "frame/backend.h"
#include "kernels/patterns_params.h"

namespace defray {

struct PatternSettings {
  /// Side n of the box, in cells of 4 px, at most 6; those around weigh (n - |dx|)(n - |dy|).
  int window_cells = 6;
  /// The best of one half plane: each counts with both its signs.
  int shifts = ChainSettings().pattern_shifts;
  int reach_x_px = 160, reach_y_px = 128;  ///< Of the shifts that are tried.
  int parallel_shifts = 4;                 ///< The best of those parallel to the picture, as many.
  int parallel_reach_x_px = 400, parallel_reach_y_px = 128;  ///< Of these.
  /// Shifts are looked for in all of a picture of up to so many pixels (4K), in strips of larger
  /// ones: so many of them, of so many rows (twice as many as shifts are long).
  std::size_t most_searched = 10'000'000;
  int strips = 3, strip_rows = 256;
  /// CoC radii that differ by no more are of one surface: rays of two such pixels land within this
  /// distance of each other, through all of the lens.
  std::int32_t tolerance_quanta = 1 << DEFRAY_COC_FRACTION_BITS;
};

struct PatternShift {
  /// From a pixel to its match, px. If parallel, along an axis: the longest that counts.
  int x, y;
  /// Not 0: a way through the scene parallel to the picture, px where 1/depth is 1. Floors and
  /// walls that slant repeat themselves along it, the shorter in the picture the farther away.
  float parallel = 0;
  /// Mean squared difference of the frame's pairs, (1/255)^2, somewhat more where few have one.
  float frame_square = 0;
  bool operator==(const PatternShift&) const = default;
};

/// What is compared. The frame's sRGB-encoded colours clipped to 0...1, 8 bits each, r | g << 8 |
/// b << 16; DEFRAY_PATTERN_KNOWN for a pure pixel of the picture whose own surface hides nothing
/// and none of whose channels lies beyond -1...1 or is not a number (a highlight belongs to its
/// place: copies of it would be new ones, and clipped it matches anything as bright); and
/// DEFRAY_PATTERN_BEHIND where something lies behind. Of wanted rows; others as `into` has them.
Words patterns_pixels(const Frame& frame, const Frame& behind, const Words& mixed, Words into = {});

/// The same of colours that are encoded, KNOWN but for their channels.
Words patterns_pixels(std::vector<std::uint32_t> encoded, const Planes& channels,
                      const std::vector<bool>& is_behind);

/// The shifts at which known pixels of one surface agree best in the mean over the frame: local
/// minima on a grid of 4 px, refined to 1 px, each followed by its opposite. Empty where less than
/// a fiftieth of the frame has partners.
std::vector<PatternShift> find_pattern_shifts(Backend& backend, const Frame& frame,
                                              const Words& pixels, const PatternSettings& settings);

/// The same for shifts parallel to the picture, to the right and down, on surfaces that slant
/// across them (on others the shifts above do): lengths at which one in 50 sampled pixels has a
/// partner and they differ less than half as much as at some shorter one.
std::vector<PatternShift> find_parallel_shifts(const Frame& frame, const Words& pixels,
                                               const PatternSettings& settings);

/// A parallel shift's way in the picture where 1/depth is `inverse`, px; 0 where that is shorter
/// than DEFRAY_PATTERN_LEAST or longer than `most`, which is less than 2^22.
inline int parallel_length(float parallel, float inverse, int most) {
  const float px = parallel * inverse;
  if (!(px >= DEFRAY_PATTERN_LEAST && px <= static_cast<float>(most))) return 0;
  // To the nearest, halves to the even one: 1.5 x 2^23 leaves no bits for the rest.
  constexpr float no_fraction = 0x1.8p23f;
  return std::bit_cast<int>(px + no_fraction) - std::bit_cast<int>(no_fraction);
}

/// Both kinds; none where nothing lies behind in the frame.
std::vector<PatternShift> find_shifts(Backend& backend, const Frame& frame, const Words& pixels,
                                      const PatternSettings& settings);

/// Rows around a pixel that its matches and their windows lie in, whatever the shifts.
int pattern_rows_around(const PatternSettings& settings);

/// Variance V of the known colours around each cell, all three together, (1/255)^2, of the surface
/// that it hides, 0 where it hides none: [rows of cells][units][DEFRAY_PATTERN_UNIT], of wanted
/// rows. A shift's D is 2 (V - covariance). Where colours change slowly, the nearest known ones are
/// closer than their mean: V is no more than known pixels differ by that far apart.
Values<float> patterns_variance(const Frame& frame, const Frame& behind, const Words& pixels,
                                const PatternSettings& settings);

/// The smooth colours of `behind`, of wanted rows, are improved in place. `pixels` are
/// patterns_pixels. Other pixels keep theirs.
void improve_by_patterns(Backend& backend, const Frame& frame, const Words& pixels,
                         const std::vector<PatternShift>& shifts, const PatternSettings& settings,
                         Frame& behind);

/// How many pairs a shift's mean over the frame counts as beside those of a window, by weight: 1.5
/// % of a whole window's. Without it, few pairs that agree by chance count for much.
float frame_pairs(int window_cells);

}  // namespace defray
