#pragma once
// The main job: one frame from file to file.
#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "image/channels.h"
#include "lens/camera.h"
#include "lens/depth.h"
#include "lens/lens.h"
#include "render.h"

namespace defray {

/// What to do with NaN and Inf colours.
enum class Nonfinite {
  error,
  zero,
  keep,  ///< They spread over the CoC of their pixel.
};

/// How to render, the same for every frame of a sequence.
struct RenderSettings {
  ChannelRequest request;
  std::vector<std::string> channels;  ///< Names or globs of further channels for the lens.
  DepthSettings depth;
  CameraValues camera;  ///< Explicit values; they win over metadata.
  bool camera_from_metadata = false;
  double metres_per_unit = 1;
  LensModel model = LensModel::cg;
  double max_coc_px = 0;
  Nonfinite nonfinite = Nonfinite::zero;
  MethodSettings method;
  TiltshiftSettings tiltshift;
};

/// Which files. Empty `depth`: depth is in `input`. Empty `coc`, `confidence`: not written.
struct FramePaths {
  std::string input, depth, output, coc, confidence = {};
};

/// What was done, for people and machines.
struct FrameReport {
  FramePaths paths;
  Method method = Method::rdb;
  std::vector<std::string> colour_channels;
  std::vector<std::string> light_channels, data_channels;  ///< Further ones, by what they hold.
  std::string depth_channel;  ///< Empty for a tilt-shift, which reads neither depth nor lens.
  Window data, display;
  Lens lens;
  DepthReport depth;
  double nearest_coc_px = 0, farthest_coc_px = 0;  ///< Signed radii: smallest and largest.
  std::size_t coc_limited = 0;                     ///< Pixels whose CoC the limit cut.
  std::size_t nonfinite = 0;                       ///< Colour values that were NaN or Inf.
  bool nonfinite_kept = false;
  std::optional<ChainReport> chain;  ///< Of the RDB with its stages.
  std::vector<std::string> notes;    ///< Whatever else the user should know.
  double read_seconds = 0, render_seconds = 0, write_seconds = 0;
};

/// The pictures of a rendered frame, for showing.
struct FrameResult {
  FrameReport report;
  std::vector<Plane> colour;  ///< As written.
};

/// Renders one frame. Throws Error.
FrameResult render_frame(const FramePaths& paths, const RenderSettings& settings, Stages& stages,
                         const Progress& progress = {});

}  // namespace defray
