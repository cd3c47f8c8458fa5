#pragma once
// What `defray render` is asked to do, and its options: one table of rows a group, each in its own
// file (options_*.cpp).
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "defray/device.h"
#include "defray/io.h"
#include "options/curve.h"
#include "options/math_words.h"
#include "options/option_table.h"
#include "options/parse.h"

namespace defray::cli {

/// Rows set members of this; finish() makes the settings complete.
struct RenderCommand {
  FramePaths paths;  ///< With the frame number's pattern, where there is one.
  std::string frames;
  RenderSettings settings;
  bool is_literal = false;
  ChainSettings chain;  ///< Of rdb, unless it is literal.
  EyeOptions eye;
  std::string camera, focus_setting;  ///< Of a camera file, or "from-metadata".
  AnimatedLens animated;
  std::optional<int> focus_frame;  ///< Of settings.focus_at; without one, each its own.
  bool no_pattern = false;
  std::vector<std::pair<std::string, std::string>> given;  ///< The options, as typed.
  /// A text with standard input and output in it as such, for people.
  std::function<std::string(const std::string&)> named = [](const std::string& text) {
    return text;
  };
  double memory_mib = static_cast<double>(default_memory_bytes >> 20);
  std::string device;
  Math math = DeviceOptions().math;
  std::vector<WorkGroup> work_groups;
  bool no_tuning = false;
  bool skip_existing = false, skip_bad_frames = false, json = false, quiet = false, show = false;
  bool stats = false;
  bool strict_target = false;
  bool no_overlap = false;  ///< Of a frame's rendering with the next's reading, the last's writing.

  /// Throws Error(usage).
  std::size_t memory_bytes() const;
  bool is_on_reference() const { return device == "reference"; }
};

/// The methods that have a lens, and so a circle of confusion by depth.
std::vector<Method> lens_methods();

/// What only the chain around the RDB has.
inline const Scope of_chain{{Method::rdb}, false, true};

OptionGroup main_options(RenderCommand& job);
OptionRow full_size_row(RenderCommand& job);  ///< Of the files.
OptionGroup file_options(RenderCommand& job);
OptionGroup channel_options(RenderCommand& job);
OptionGroup lens_options(RenderCommand& job);
OptionGroup method_options(RenderCommand& job);
OptionGroup tiltshift_options(TiltshiftSettings& tiltshift);
OptionRow quality_row(ChainSettings& chain);  ///< Before what it sets: --rdb, --hidden.
OptionGroup chain_options(ChainSettings& chain);
OptionGroup aperture_options(RenderCommand& job);
OptionGroup device_options(RenderCommand& job);
OptionGroup terminal_options(RenderCommand& job);

/// All of them, in the order of --help and of their setting.
std::vector<OptionGroup> render_options(RenderCommand& job);

/// What follows from the options together: memory, stages. Throws Error(usage) on values and
/// combinations that are not allowed.
void finish(RenderCommand& job);

/// "defray render" with what was given, but for the options that are left out.
std::string render_command_line(const std::vector<std::pair<std::string, std::string>>& given,
                                const std::function<bool(const std::string&)>& is_left_out);

/// The settings of a frame: typed values win over the eye's, those over the camera file's or the
/// metadata's. Throws Error(usage), and Error(input) for a camera file.
RenderSettings settings_at(const RenderCommand& job, std::optional<int> frame);

/// Throws Error as settings_at does, for what is wrong before any frame is read.
void check_lens(const RenderCommand& job, const std::vector<std::optional<int>>& frames);

}  // namespace defray::cli
