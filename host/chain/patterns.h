#pragma once
// What lies behind, continued from elsewhere in the picture: repeating surfaces look alike at a few
// shifts (He & Sun 2012, "Statistics of patch offsets for image completion"). Where the
// surroundings of a hidden pixel agree with those of its shifted selves, their colours replace the
// smooth one, by as much as the agreement explains.
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "lens/coc.h"
#include "opencl/session.h"

namespace defray {

/// A frame with its synthesised layer. All planes are [height][width].
struct PatternFrame {
  int width, height;
  /// sRGB-encoded colour clipped to 0...1, 8 bits each, r | g << 8 | b << 16, and
  /// DEFRAY_PATTERN_KNOWN for a pure pixel whose own surface hides nothing.
  const std::vector<std::uint32_t>& encoded;
  const std::vector<std::int32_t>& coc_quanta;
  const std::vector<std::int32_t>& behind_coc;  ///< Of the synthesised layer.
  const std::vector<std::uint32_t>& behind;     ///< 1 where there is a synthesised fragment.
  const Plane& inverse;                         ///< 1/depth.
  const Plane& behind_inverse;                  ///< Of the synthesised layer.
};

struct PatternSettings {
  int window_px = 25;  ///< Side n of the box, at most 48; pairs weigh (n - |dx|)(n - |dy|).
  int shifts = 24;     ///< The best of one half plane: each counts with both its signs.
  int reach_x_px = 160, reach_y_px = 128;  ///< Of the shifts that are tried.
  int parallel_shifts = 4;                 ///< The best of those parallel to the picture, as many.
  int parallel_reach_x_px = 400, parallel_reach_y_px = 128;  ///< Of these.
  /// CoC radii that differ by no more are of one surface: rays of two such pixels land within this
  /// distance of each other, through all of the lens.
  std::int32_t tolerance_quanta = 1 << DEFRAY_COC_FRACTION_BITS;
  std::size_t memory_bytes = default_memory_bytes;  ///< For one band's planes.
};

struct PatternShift {
  /// From a pixel to its match, px. If parallel, along an axis: the longest that counts.
  int x, y;
  /// Not 0: a way through the scene parallel to the picture, px where 1/depth is 1. Floors and
  /// walls that slant repeat themselves along it, the shorter in the picture the farther away.
  float parallel = 0;
  bool operator==(const PatternShift&) const = default;
};

/// The frame's colours with DEFRAY_PATTERN_KNOWN taken from pixels with a channel beyond -1...1 or
/// not a number (a highlight belongs to its place: copies of it would be new ones, and clipped it
/// matches anything as bright), and DEFRAY_PATTERN_BEHIND added.
std::vector<std::uint32_t> pattern_pixels(const PatternFrame& frame,
                                          const std::vector<Plane>& channels);

/// The shifts at which known pixels of one surface agree best in the mean over the frame: local
/// minima on a grid of 4 px, refined to 1 px, each followed by its opposite. Empty where less than
/// a fiftieth of the frame has partners.
std::vector<PatternShift> find_pattern_shifts(const PatternFrame& frame,
                                              const std::vector<std::uint32_t>& pixels,
                                              const PatternSettings& settings);

/// The same for shifts parallel to the picture, to the right and down, on surfaces that slant
/// across them (on others the shifts above do): lengths at which one in 50 sampled pixels has a
/// partner and they differ less than half as much as at some shorter one.
std::vector<PatternShift> find_parallel_shifts(const PatternFrame& frame,
                                               const std::vector<std::uint32_t>& pixels,
                                               const PatternSettings& settings);

/// A shift where 1/depth is `inverse`: its way in the picture, px; {0, 0} where a parallel one is
/// shorter than DEFRAY_PATTERN_LEAST or longer than its longest.
PatternShift shift_at(const PatternShift& shift, float inverse);

/// Sums over shifts; defined where there is a fragment behind.
struct PatternSums {
  std::vector<Plane> difference;  ///< Of w (match's colour - smooth colour), a channel each.
  Plane weight;                   ///< Of w.
  Plane weighted_square;          ///< Of w D, D the squared difference of surroundings, (1/255)^2.
};

PatternSums match_patterns(Session& session, const PatternFrame& frame,
                           const std::vector<std::uint32_t>& pixels,
                           const std::vector<Plane>& channels, const std::vector<Plane>& behind,
                           const std::vector<PatternShift>& shifts, const PatternSettings& settings,
                           const std::function<void(double)>& progress = {});

/// Variance V of the known colours around each fragment, all three together, (1/255)^2. A shift's
/// D is 2 (V - covariance).
Plane pattern_variance(const PatternFrame& frame, const std::vector<std::uint32_t>& pixels,
                       const PatternSettings& settings);

/// Moves `behind` towards the matches' mean by the gain of linear regression, covariance / variance
/// = 1 - D / 2 V, clamped to 0...1: not at all where surroundings agree by chance only.
void blend_patterns(const PatternFrame& frame, const PatternSums& sums, const Plane& variance,
                    std::vector<Plane>& behind);

/// `match_patterns`, or its twin, for a frame.
using PatternMatcher = std::function<PatternSums(const std::vector<std::uint32_t>& pixels,
                                                 const std::vector<PatternShift>& shifts)>;

/// All of it. `channels` are the frame's linear colours, 1 to 4; `behind` as many planes, the
/// synthesised fragments' smooth colours, improved in place. Other pixels keep theirs.
void improve_by_patterns(const PatternFrame& frame, const std::vector<Plane>& channels,
                         const PatternSettings& settings, std::vector<Plane>& behind,
                         const PatternMatcher& match);
void improve_by_patterns(Session& session, const PatternFrame& frame,
                         const std::vector<Plane>& channels, const PatternSettings& settings,
                         std::vector<Plane>& behind,
                         const std::function<void(double)>& progress = {});

// Single kernels over a whole frame, for one shift: [height][width].
std::vector<std::uint32_t> pattern_difference_on_device(Session& session, const PatternFrame& frame,
                                                        const std::vector<std::uint32_t>& pixels,
                                                        PatternShift shift,
                                                        const PatternSettings& settings);
std::vector<std::uint64_t> pattern_columns_on_device(Session& session, const PatternFrame& frame,
                                                     const std::vector<std::uint32_t>& pixels,
                                                     PatternShift shift,
                                                     const PatternSettings& settings);

/// Weight of the pairs that a match needs: a tenth of a whole window's.
std::uint32_t least_pairs(int window_px);

}  // namespace defray
