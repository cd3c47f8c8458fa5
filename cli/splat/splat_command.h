#pragma once
// defray splat: what is to be done, and the options that say so.
#include <optional>
#include <string>
#include <vector>

#include "defray/splat.h"
#include "options/curve.h"
#include "options/option_table.h"

namespace defray::cli {

struct SplatCommand {
  std::string input, model;
  bool has_cache = false;
  std::size_t model_points = 0;  ///< 0: the model's own number.
  std::string output;
  std::optional<std::array<double, 3>> from, look_at, up;
  CameraValues camera;
  EyeOptions eye;
  double max_coc_px = Lens().max_coc_px;
  AnimatedLens animated;
  std::string camera_file, focus_setting;
  double metres_per_unit = Lens().metres_per_unit;
  SplatSettings settings;
  int turntable = 0;  ///< Frames of a turn; 0: none.
  std::string frames;
  std::string device;
  bool no_tuning = false;
  bool has_depth = false, has_fragments = false;  ///< Channels beside R G B A.
  bool makes_folders = false, skip_existing = false;
  bool json = false, quiet = false, show = false;
};

std::vector<OptionGroup> splat_options(SplatCommand& job);

}  // namespace defray::cli
