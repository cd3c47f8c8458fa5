#pragma once
// Two pictures of the command line, compared.
#include <optional>
#include <string>
#include <vector>

#include "commands/colour_file.h"
#include "measure/false_edges.h"
#include "measure/metrics.h"

namespace defray::cli {

struct CompareOptions {
  std::string a, b;
  std::optional<double> min_psnr, min_ssim, max_error, max_false_edges, max_false_changes;
  std::string depth, depth_channel, camera, focus_setting;
  std::string windows = "union", crop, mask;
  std::string frames;
  double edge_step = 0.1;
  bool false_edges = false;
  std::string sheet;
  double amplify = 4;
  bool json = false;

  /// Paths with a frame's number instead of their pattern.
  CompareOptions of_frame(int frame) const;
};

/// Two pictures of one window.
struct Pair {
  ColourFile a, b;
};

/// Errors inside the edge band and outside it.
struct BandErrors {
  Errors inside, outside;
};

/// What is said of two pictures.
struct Found {
  Comparison comparison;
  std::optional<double> alpha_difference;  ///< The largest, where both have alpha.
  std::optional<BandErrors> band;
  std::optional<Excess> false_edges;
  std::optional<Excess> false_changes;  ///< Since the frame before.
};

/// Reads both and what of them is looked at. Throws Error(usage), Error(input).
Pair read_pair(const CompareOptions& o);

/// Places are of the display window's left upper corner, as --crop is. `before`: the last frame.
/// Throws Error(input) where depth, camera or mask do not serve.
Found compare_pair(const CompareOptions& o, const Pair& pair, const Pair* before);

}  // namespace defray::cli
