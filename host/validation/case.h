#pragma once
// One input for a kernel and its twin, made from a few words: they reproduce it anywhere.
#include <cstdint>
#include <string>
#include <vector>

namespace defray::validation {

/// How depth and CoC lie in the frame.
enum class Pattern {
  constant,    ///< One depth, one CoC.
  slanted,     ///< Both linear along x, the CoC from minus to plus its largest.
  steps,       ///< Rectangles: discontinuities.
  random,      ///< Every pixel for itself, depths of all magnitudes.
  ties,        ///< Few depths, CoC in whole and half pixels: equal keys, rays on pixel borders.
  converging,  ///< Whole rows (odd seeds: columns) of rays meet in one pixel, each nearer than the
               ///< one before: through the lens coordinate 1/2, as 2 x 2 cells have it.
  checker,     ///< A checkerboard of near and far.
  sparse,      ///< In focus, but for a few pixels of the largest CoC.
};

enum class Colours {
  plain,      ///< 0 to 1.
  wild,       ///< 2^-6 to 2^6, some negative.
  extreme,    ///< +-0, denormals, 65504, 1e30, the largest float.
  nonfinite,  ///< plain with some NaN and Inf.
};

struct Case {
  int width = 64, height = 48;
  Pattern pattern = Pattern::random;
  double coc_px = 8;  ///< Largest CoC radius.
  Colours colours = Colours::plain;
  int channels = 4;
  int cells = 4;                 ///< RDB cells a side.
  int samples = 8;               ///< Of the gather.
  bool jitter = false;           ///< RDB jitter, gather rotation.
  int band_rows = 0;             ///< Rows that the memory holds; 0: as it comes.
  int group_x = 0, group_y = 0;  ///< Work-group; 0: the kernel's default.
  double focus = 3;              ///< Scene units; infinity is allowed.
  std::uint32_t seed = 1;

  bool operator==(const Case&) const = default;
};

/// "257x89,ties,coc=8,wild,channels=3,cells=4,samples=8,jitter,band=5,group=7x3,focus=3,seed=3".
std::string to_string(const Case& c);

/// The reverse; what is not said keeps its default. Throws Error(usage) on an empty text, unknown
/// words, values out of range, and frames above 2^22 pixels.
Case parse_case(const std::string& text);

}  // namespace defray::validation
