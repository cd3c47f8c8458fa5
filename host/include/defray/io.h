#pragma once
// Pictures in files: EXR, TIFF, HDR, PNG, JPEG.
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "defray/device.h"
#include "defray/export.h"
#include "defray/frame.h"
#include "defray/lens.h"
#include "defray/options.h"
#include "defray/report.h"

namespace defray {

/// Which channels of a file are meant; empty: choose, and fail where the choice is not clear.
struct ChannelRequest {
  std::string layer;
  std::string view;
  std::string depth_channel;
};

/// A picture with depth, read from a file, and all else that the file has.
class DEFRAY_API PictureFile {
 public:
  /// Depth is from `depth_path`, or the file itself where that is empty. PNG and JPEG are decoded
  /// from sRGB. Throws Error(input) naming the file: missing, unreadable, no colour, no depth, or
  /// several of them and no request that says which.
  static PictureFile read(const std::string& path, const ChannelRequest& request = {},
                          const std::string& depth_path = "");

  PictureFile(PictureFile&&) noexcept;
  PictureFile& operator=(PictureFile&&) noexcept;
  ~PictureFile();

  /// R G B (A), or a grey file's Y (A), and depth as stored, in memory of this object.
  const Picture& picture() const;

  /// Writes the file anew to `path`, `colour` in place of its own. The same format keeps channels,
  /// windows, metadata and types; another one what it can hold: returns notes of what it left out.
  /// Throws Error(usage) for an extension that defray does not write, Error(output).
  std::vector<std::string> write(const std::string& path,
                                 const std::vector<std::vector<float>>& colour);

  /// Writes one plane of floats (`coc`, `confidence`) with the windows and metadata of the file, to
  /// .exr or .tif. Throws as write does.
  void write_plane(const std::string& path, const std::string& name,
                   const std::vector<float>& values) const;

 private:
  struct State;
  explicit PictureFile(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

struct PixelPlace {
  int x = 0, y = 0;
};

/// How to render from file to file, the same for every frame of a sequence.
struct RenderSettings {
  ChannelRequest request;
  std::vector<std::string> channels;  ///< Names or globs of further channels for the lens.
  std::string compression;            ///< Of EXR and TIFF outputs, "zip"; empty: the input's.
  DepthSettings depth;
  CameraValues camera;  ///< Explicit values; they win over metadata.
  bool camera_from_metadata = false;
  double metres_per_unit = Lens().metres_per_unit;
  LensModel model = Lens().model;
  double max_coc_px = Lens().max_coc_px;
  /// Focus on the depth found there, of the display window, instead of a distance.
  std::optional<PixelPlace> focus_at;
  /// The picture is a cut-out of a frame of this width and height, its left upper pixel at (x, y)
  /// in it: the frame that the lens's field of view spans, instead of the display window.
  std::optional<Window> full_size;
  Bits bits = Bits::as_input;
  std::optional<Grow> grow;  ///< Empty: display where there is an alpha below 1, none elsewhere.
  Nonfinite nonfinite = Options().nonfinite;
  ErrorSettings error;                ///< FramePaths::error asks for what is expected, too.
  MethodSettings method = Options();  ///< As it is: the RDB with all its stages.
  std::optional<double> budget_ms;    ///< As Options::budget_ms.
  TiltshiftSettings tiltshift;
  bool make_folders = false;  ///< Of the outputs, where there are none, when they are written.
};

/// Which files. Empty `depth`: depth is in `input`. Of what else is written, empty: not written.
struct FramePaths {
  std::string input, depth, output, coc, confidence = {}, tiles = {}, error = {};

  /// What is written beside the picture, by the fields' names; empty ones too.
  std::vector<std::pair<const char*, std::string>> data_outputs() const {
    return {{"coc", coc}, {"confidence", confidence}, {"tiles", tiles}, {"error", error}};
  }
};

/// What was done, for people and machines.
struct FrameReport : RenderReport {
  FramePaths paths;
  Method method = MethodSettings().method;
  std::vector<std::string> colour_channels;
  std::vector<std::string> light_channels, data_channels;  ///< Further ones, by what they hold.
  std::string depth_channel;  ///< Empty for a tilt-shift, which reads neither depth nor lens.
  Window data, display;
  Lens lens;
  bool nonfinite_kept = false;
  /// Whatever else the user should know; settings in them are marked, for with_field_names.
  std::vector<std::string> notes;
  double read_seconds = 0, render_seconds = 0, write_seconds = 0;
  double predict_seconds = 0;  ///< Finding `expected`; not in render_seconds.
};

/// The pictures of a rendered frame, for showing.
struct FrameResult {
  FrameReport report;
  std::vector<std::vector<float>> colour;  ///< As written.
};

/// One frame from file to file in three steps, each once and in this order. A frame's read() and
/// write() may go on in other threads while the device renders another's.
class DEFRAY_API FileRender {
 public:
  FileRender(const FramePaths& paths, const RenderSettings& settings);
  FileRender(FileRender&&) noexcept;
  FileRender& operator=(FileRender&&) noexcept;
  ~FileRender();

  /// Looks whether the outputs can be written, and reads the input. Throws Error.
  void read();
  /// `before`: expected() of the frame before in a sequence, for settings with a target. Throws
  /// Error, of kind usage before read().
  void render(Device& device, const Progress& progress = {},
              const std::optional<ExpectedError>& before = {});
  /// Of what was rendered.
  const std::optional<ExpectedError>& expected() const;
  /// Throws Error, of kind usage before render().
  FrameResult write();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// What a frame would be rendered with: its lens (what `focus_at` means there), depths, channels.
/// Throws Error.
DEFRAY_API FrameReport inspect_file(const FramePaths& paths, const RenderSettings& settings);

/// Renders one frame from file to file, as `defray render` does. Throws Error.
DEFRAY_API FrameResult render_file(Device& device, const FramePaths& paths,
                                   const RenderSettings& settings, const Progress& progress = {});

}  // namespace defray
