// defray render: one picture or a sequence through the lens.
#include <filesystem>

#include "commands.h"
#include "defray/defray.h"
#include "exit_code.h"
#include "image/display.h"
#include "image/output.h"
#include "image/sequence.h"
#include "progress.h"
#include "render_job.h"
#include "render_report.h"

namespace defray::cli {
namespace {

constexpr const char* footer =
    R"(Units: focus, --near, --far and depth in scene units (--unit says what one is); focal length,
sensor and aperture in millimetres; CoC in pixels (radius, negative in front of the focus).

Examples:
  defray render beauty.exr -o out.exr --focus 3 --fstop 2.8 --focal-length 50 --sensor-width 36
  defray render 'shot.####.exr' -o 'out/shot.####.exr' --frames 1-8 --camera camera.json
  defray render beauty.png --depth z.exr -o out.png --focus 1.2 --fstop 1.4 --focal-length 35
  defray render vray.exr -o out.exr --depth-kind normalized --invert --near 0.5 --far 40 \
      --focus 3 --fstop 4 --focal-length 50)";

/// The frames to render; a single empty one for a picture without a pattern.
std::vector<std::optional<int>> frames_of(const RenderJob& job) {
  const FramePaths& p = job.paths;
  const bool is_sequence = has_frame_pattern(p.input);
  if (!is_sequence) {
    if (!job.frames.empty()) {
      fail(ErrorKind::usage, "--frames needs a pattern in the input name, such as shot.####.exr");
    }
    for (const std::string& name : {p.output, p.coc, p.confidence, p.tiles}) {
      if (!name.empty() && has_frame_pattern(name)) {
        fail(ErrorKind::usage, "{}: has a frame pattern, the input {} has none", name, p.input);
      }
    }
    return {std::nullopt};
  }
  const std::vector<int> numbers =
      job.frames.empty() ? find_frames(p.input) : parse_frames(job.frames);
  for (const std::string& name : {p.output, p.coc, p.confidence, p.tiles}) {
    if (numbers.size() > 1 && !name.empty() && !has_frame_pattern(name)) {
      fail(ErrorKind::usage, "{}: {} frames would go to one file; put #### in its name", name,
           numbers.size());
    }
  }
  return {numbers.begin(), numbers.end()};
}

FramePaths paths_of(FramePaths paths, std::optional<int> frame) {
  if (!frame) return paths;
  for (std::string* path :
       {&paths.input, &paths.depth, &paths.output, &paths.coc, &paths.confidence, &paths.tiles}) {
    if (!path->empty()) *path = frame_path(*path, *frame);
  }
  return paths;
}

Device open_device(const RenderJob& job) {
  check_output_format(job.paths.output);
  Device device = Device::open(job.device, {job.math});
  if (job.is_on_reference()) return device;
  device.set_memory(job.memory_bytes());
  for (const WorkGroup& group : job.work_groups) {
    if (group.kernel.empty()) {
      device.set_work_group(group.x, group.y);
    } else {
      device.set_work_group(group.kernel, group.x, group.y);
    }
  }
  return device;
}

/// Renders frame after frame and tells about each.
class SequenceRun {
 public:
  SequenceRun(const RenderJob& job, std::size_t frame_count)
      : job_(job),
        bar_(frame_count, frame_count == 1 ? "frame" : "frames", !job.quiet),
        device_(open_device(job)) {}

  /// False when the frame failed and --skip-bad-frames lets the run go on.
  bool render(std::optional<int> frame, std::size_t done) {
    FrameOutcome outcome{frame, paths_of(job_.paths, frame), "ok", "", {}};
    if (job_.skip_existing && std::filesystem::exists(outcome.paths.output)) {
      outcome.status = "skipped";
      report(outcome);
      return true;
    }
    try {
      bar_.update(done, 0);
      FrameResult result = render_file(device_, outcome.paths, job_.settings,
                                       [&](double share) { bar_.update(done, share); });
      outcome.report = std::move(result.report);
      last_ = std::move(result.colour);
    } catch (const Error& error) {
      outcome.status = "failed";
      outcome.error = message_of(error);
      if (job_.json) report(outcome);
      bar_.clear();
      if (!job_.skip_bad_frames || error.kind() == ErrorKind::device) throw;
      fmt::print(stderr, "defray: error: {}\n", outcome.error);
      return false;
    }
    last_data_ = outcome.report.data;
    last_display_ = outcome.report.display;
    report(outcome);
    return true;
  }

  void show_last() {
    std::string why;
    if (last_.empty()) return;
    if (!has_display(why)) {
      fmt::print(stderr, "defray: --show skipped: {}\n", why);
      return;
    }
    bar_.clear();
    show("defray: " + job_.paths.output, to_display_window(last_, last_data_, last_display_),
         last_display_.width, last_display_.height);
  }

 private:
  void report(const FrameOutcome& outcome) {
    bar_.clear();
    if (job_.json) {
      print_json_line(outcome, device_.name());
    } else if (!job_.quiet) {
      print_text(outcome, device_.name());
      if (job_.stats) print_stats(outcome.report);
    }
  }

  const RenderJob& job_;
  ProgressBar bar_;
  Device device_;
  std::vector<Plane> last_;
  Window last_data_, last_display_;
};

int run(const OptionTable& options, RenderJob& job) {
  options.set();
  const auto frames = frames_of(job);
  options.refuse_idle({job.settings.method.method, job.is_literal, job.is_on_reference()});
  finish(job);
  SequenceRun sequence(job, frames.size());
  std::size_t failed = 0;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (!sequence.render(frames[i], i)) ++failed;
  }
  if (job.show) sequence.show_last();
  if (failed > 0) {
    fmt::print(stderr, "defray: error: {} of {} frames failed\n", failed, frames.size());
    return ExitCode::failed;
  }
  return ExitCode::ok;
}

}  // namespace

Run add_render(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("render", "Render depth of field into a picture or a sequence");
  command->footer(footer);
  const auto job = std::make_shared<RenderJob>();
  const OptionTable options(*command, render_options(*job));
  return [options, job] { return run(options, *job); };
}

}  // namespace defray::cli
