#pragma once
// defray render over its frames: while the device renders one, the next is read and the last is
// written.
#include <future>
#include <memory>
#include <optional>
#include <vector>

#include "base/plane.h"
#include "defray/defray.h"
#include "frame_report.h"
#include "progress.h"
#include "render/render_command.h"
#include "render/render_report.h"

namespace defray::cli {

/// The files of a frame; those of a picture as they are.
FramePaths paths_of(FramePaths paths, std::optional<int> frame);

/// All that is written, where no name: nothing.
std::vector<std::string> outputs_of(const FramePaths& paths);

/// Whether --skip-existing leaves this frame alone.
bool is_skipped(const RenderCommand& job, std::optional<int> frame);

class SequenceRun {
 public:
  /// Opens the device. A single frame without a number is a picture. Throws Error.
  SequenceRun(const RenderCommand& job, std::vector<std::optional<int>> frames);

  /// Renders all, and tells about each in its order. Throws the Error of the first that fails,
  /// unless --skip-bad-frames lets the run go on.
  void render();

  /// Frames that have failed.
  std::size_t failed() const { return failed_; }

  /// Frames of which no quality is expected to reach the target.
  std::size_t missed() const { return missed_; }

  /// The last picture in a window.
  void show_last();

 private:
  /// A frame on its way: what goes wrong in one step keeps it from the next.
  struct Work {
    FrameOutcome outcome;
    std::unique_ptr<FileRender> file;  ///< None where the frame is skipped.
    std::optional<Error> error;
    std::vector<Plane> colour;  ///< As written.

    template <typename Step>
    void attempt(const Step& step);
  };

  Work read(std::optional<int> frame) const;
  void finish(Work work);
  void report(FrameOutcome outcome);

  const RenderCommand& job_;
  std::vector<std::optional<int>> frames_;
  ProgressBar bar_;
  std::optional<Device> device_;  ///< Opened while the first frame is read.
  std::size_t failed_ = 0, missed_ = 0;
  std::optional<ExpectedError> before_;  ///< Of the last frame: where a target's search goes on.
  FrameNotes notes_;
  bool is_mute_ = false;  ///< Standard output takes no more.
  std::vector<Plane> last_;
  Window last_data_, last_display_;
};

}  // namespace defray::cli
