#pragma once
// What a render tells about itself.
#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "defray/options.h"

namespace defray {

/// Gets the share done, 0 to 1.
using Progress = std::function<void(double)>;

/// Of the conversion to planar depth.
struct DepthReport {
  std::size_t background = 0;     ///< Pixels taken as background.
  std::size_t not_a_number = 0;   ///< NaN pixels, taken as background too.
  std::size_t outside_range = 0;  ///< normalized, zbuffer: stored values outside 0...1.
  std::size_t behind_camera = 0;  ///< Of the background, numbers of the wrong sign.
  double nearest_units = 0;       ///< Range of the rest; 0 where nothing is left.
  double farthest_units = 0;
};

/// A stage, its time, and the memory that a device had to make for it.
struct StageTime {
  std::string stage;
  double seconds;
  std::size_t bytes = 0;
};

/// Shares of a picture's tiles of 16 px by what they hold, each of the last that is true.
struct TileShares {
  std::size_t tiles = 0;  ///< In all.
  double in_focus = 0;    ///< Every CoC below half a pixel.
  double smooth = 0;      ///< Surfaces that the lens does not part.
  double mixed = 0;       ///< Mixed pixels.
  double hidden = 0;      ///< A made-up surface behind.
  double lights = 0;      ///< Highlights that became discs.
};

/// Of the stages around the ray distribution buffer.
struct ChainReport {
  std::size_t repaired = 0;      ///< Pixels of anti-aliased depth.
  std::size_t behind = 0;        ///< Pixels with a made-up surface behind them.
  std::size_t split = 0;         ///< Mixed pixels taken apart.
  std::size_t highlights = 0;    ///< Fragments whose light became a disc.
  std::size_t interpolated = 0;  ///< Pixels of large circles between rows whose rays were found.
  int border_px = 0;             ///< By how much the frame was extended.
  bool border_is_cut = false;    ///< Rays come from farther outside still.
  int lens_points = 0;
  double confidence = 0;  ///< Mean share of rays that the input determines.
  std::vector<StageTime> stages;
  TileShares tiles;
};

/// How far a picture is from what a ray tracer would give, expected without one, from how the
/// pictures look. It stands for cameras and scenes like those that it was learnt from: opaque
/// surfaces, colour anti-aliased, depth not.
struct ExpectedError {
  /// PSNR of the whole frame as `defray compare` gives it: sRGB-encoded, clipped. At most 90.
  double psnr_db = 0;
  double low_db = 0, high_db = 0;  ///< Between these in nine of ten scenes.
  /// Of the squared error: too few lens points; made-up surfaces; edges, and rims of highlights;
  /// the picture's own sampling and what half the size loses.
  std::array<double, 4> shares{};
  std::optional<Quality> quality;  ///< Where ErrorSettings::target_db chose it, with
  int cells_per_side = 0;          ///< ChainSettings::cells_per_side.
  bool misses_target = false;      ///< No quality is expected to reach it.
  /// With target_db, what the next frame of a sequence begins with: the same, but where much less
  /// work is likely to do.
  std::optional<Quality> next_quality = {};
  int next_cells_per_side = 0;
};

/// What a budget of time chose.
struct BudgetChoice {
  Quality quality = Quality::preview;
  int cells_per_side = 0;                 ///< ChainSettings::cells_per_side with that quality.
  double expected_ms = 0, budget_ms = 0;  ///< Above the budget: the fastest quality is.
};

/// Of a render.
struct RenderReport {
  DepthReport depth;
  double nearest_coc_px = 0, farthest_coc_px = 0;  ///< Signed radii: smallest and largest.
  std::size_t coc_limited = 0;                     ///< Pixels whose CoC the limit cut.
  std::size_t nonfinite = 0;                       ///< Colour values that were NaN or Inf.
  std::optional<ChainReport> chain;                ///< Of the RDB with its stages.
  std::optional<ExpectedError> expected;           ///< Of the same, where it was asked for.
  /// Work-groups that `defray tune` found and that were used: "fill=16x1".
  std::vector<std::string> tuned;
  std::optional<BudgetChoice> budget;  ///< Where one was given.
};

}  // namespace defray
