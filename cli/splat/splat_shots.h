#pragma once
// The pictures that defray splat makes: the camera and lens of each frame.
#include <optional>
#include <string>
#include <vector>

#include "splat/splat_command.h"

namespace defray::cli {

/// A picture that is to be made, as far as it is known without the points.
struct SplatShot {
  std::optional<int> frame;
  std::string output;
  CameraValues camera;
  double max_coc_px = 0;
  std::optional<CameraPose> stated;  ///< What a camera file says.
};

/// All of them: a turn's, those of --frames, those of a camera file a frame, or a single one.
/// Throws Error(usage), and Error(input) for a camera file.
std::vector<SplatShot> shots_of(const SplatCommand& job);

struct SplatCamera {
  CameraPose pose;
  Lens lens;
  std::vector<std::string> notes;  ///< On the camera file, and on what no real lens has.
};

/// Options win over the camera file, and that over a view of all of the model in which what is
/// looked at is in focus.
SplatCamera camera_of(const SplatCommand& job, const SplatShot& shot, const SplatModel& model);

}  // namespace defray::cli
