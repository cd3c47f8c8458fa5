#pragma once
// defray render, in four files: options (render_options.cpp, those of the methods in
// render_method.cpp), the run over frames (render.cpp), what is printed (render_report.cpp).
#include <cstdint>
#include <optional>
#include <string>

#include "aperture_options.h"
#include "base/window.h"
#include "commands.h"
#include "defray/io.h"

namespace defray::cli {

/// The command line of `defray render` as typed; to_settings gives it meaning.
struct RenderOptions {
  std::string input, output, depth, coc_out, confidence_out, frames;
  std::string layer, view, depth_channel;
  std::optional<std::string> channels;
  std::string depth_kind = "z", background, unit = "m";
  double near_units = 0, far_units = 0;
  bool invert = false;
  std::optional<double> focus, fstop, aperture_diameter, focal_length, sensor_width;
  std::optional<double> max_coc;
  std::optional<double> pixel_scale, scale, perceived_distance;
  std::optional<double> display_distance, display_resolution;
  std::string eye;  ///< Empty: no eye.
  std::string camera, focus_setting, lens_model = "cg";
  std::string method = "rdb", nonfinite = "zero";
  std::optional<int> rdb, samples, passes;
  std::string gather;
  bool literal = false, keep_depth = false;
  std::string quality, hidden, edges, highlights, border;
  ApertureOptions aperture;
  bool jitter = false, rotate = false;
  std::optional<std::uint32_t> seed;
  std::optional<double> band_centre, band_width, max_blur;
  std::optional<double> memory_mib;
  std::string device, work_group, math = "strict";
  bool skip_existing = false, skip_bad_frames = false, json = false, quiet = false, show = false;
};

void add_render_options(CLI::App& command, RenderOptions& options);

/// What brings the RDB closer to the truth (render_defocus.cpp).
void add_defocus_options(CLI::App& command, RenderOptions& options);
ChainSettings to_chain(const RenderOptions& options);

/// The lens and the method (render_method.cpp).
void add_method_options(CLI::App& command, RenderOptions& options);
MethodSettings to_method(const RenderOptions& options);

/// --memory. Throws Error(usage).
std::size_t memory_bytes(const RenderOptions& options);
TiltshiftSettings to_tiltshift(const RenderOptions& options);

/// Throws Error(usage) on values that are not allowed.
RenderSettings to_settings(const RenderOptions& options);

/// What became of one frame.
struct FrameOutcome {
  std::optional<int> frame;  ///< Empty for a single picture.
  FramePaths paths;
  std::string status;  ///< ok, skipped, failed.
  std::string error;
  FrameReport report;  ///< Of an ok frame.
};

void print_text(const FrameOutcome& outcome, const std::string& device);
void print_json_line(const FrameOutcome& outcome, const std::string& device);

}  // namespace defray::cli
