#pragma once
// The lens picture, closer to the truth than the rays of visible pixels alone: what lies behind
// near surfaces, mixed pixels, highlights, borders. A chain of stages before and after the ray
// distribution buffers; each can be left out.
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "frame/stages.h"
#include "lens/aperture.h"

namespace defray {

/// What is taken to be outside the frame. The data window is the frame: overscan is used as it is.
enum class Border {
  clamp,        ///< The frame's edge goes on, as far as it can reach in, at most half the frame.
  black,        ///< The same surfaces, without light.
  renormalise,  ///< Nothing: pixels are means over the rays that are known.
};

/// What is done about what lies behind.
enum class Hidden {
  off,
  smooth,  ///< Made up from what is around.
  on,      ///< And from where the picture repeats itself.
};

struct ChainSettings {
  int cells_per_side = 13;  ///< As many lens points as round cells of such a grid.
  Hidden hidden = Hidden::on;
  int pattern_shifts = 24;  ///< Shifts at which Hidden::on looks, each with both its signs.
  bool split_edges = true;
  bool repair_depth = true;
  bool highlights = true;
  bool soften = true;
  Border border = Border::clamp;
  Aperture aperture;
};

enum class Quality { draft, normal, high };

/// What goes together, the fastest first; Quality::normal is ChainSettings().
ChainSettings settings_for(Quality quality);

/// A stage and its time.
struct StageTime {
  std::string stage;
  double seconds;
};

struct ChainReport {
  std::size_t repaired = 0;    ///< Pixels of anti-aliased depth.
  std::size_t behind = 0;      ///< Pixels with a made-up surface behind them.
  std::size_t split = 0;       ///< Mixed pixels taken apart.
  std::size_t highlights = 0;  ///< Fragments whose light became a disc.
  int border_px = 0;           ///< By how much the frame was extended.
  bool border_is_cut = false;  ///< Rays come from farther outside still.
  int lens_points = 0;
  double confidence = 0;  ///< Mean share of rays that the input determines.
  std::vector<StageTime> stages;
};

/// What a method gives.
struct MethodResult {
  std::vector<Plane> colour;
  /// Share of each pixel's lens rays that end on what the picture shows, 0 to 1. Of the chain.
  Plane confidence = {};
  /// The pixel whose data (ids, normals) each pixel gets: that of the nearest surface its rays end
  /// on, made-up ones left out; its own where there is none. Of rays, if wanted.
  std::vector<std::uint32_t> nearest = {};
  ChainReport report = {};
};

/// `frame` has coc_quanta, depth and channels; `seed` is for what is random. Throws Error(usage)
/// for settings out of range.
MethodResult run_chain(const Frame& frame, const ChainSettings& settings, Stages& stages,
                       bool wants_nearest = false, const Progress& progress = {});

}  // namespace defray
