// defray render: one picture or a sequence through the lens.
#include "render.h"

#include <filesystem>

#include "defray/defray.h"
#include "exit_code.h"
#include "image/display.h"
#include "image/output.h"
#include "image/sequence.h"
#include "options.h"
#include "parse.h"
#include "progress.h"

namespace defray::cli {
namespace {

/// The frames to render; a single empty one for a picture without a pattern.
std::vector<std::optional<int>> frames_of(const RenderOptions& o) {
  const bool is_sequence = has_frame_pattern(o.input);
  if (!is_sequence) {
    if (!o.frames.empty()) {
      fail(ErrorKind::usage, "--frames needs a pattern in the input name, such as shot.####.exr");
    }
    for (const std::string& name : {o.output, o.coc_out, o.confidence_out}) {
      if (!name.empty() && has_frame_pattern(name)) {
        fail(ErrorKind::usage, "{}: has a frame pattern, the input {} has none", name, o.input);
      }
    }
    return {std::nullopt};
  }
  const std::vector<int> numbers = o.frames.empty() ? find_frames(o.input) : parse_frames(o.frames);
  for (const std::string& name : {o.output, o.coc_out, o.confidence_out}) {
    if (numbers.size() > 1 && !name.empty() && !has_frame_pattern(name)) {
      fail(ErrorKind::usage, "{}: {} frames would go to one file; put #### in its name", name,
           numbers.size());
    }
  }
  return {numbers.begin(), numbers.end()};
}

FramePaths paths_of(const RenderOptions& o, std::optional<int> frame) {
  FramePaths paths{o.input, o.depth, o.output, o.coc_out, o.confidence_out};
  if (!frame) return paths;
  for (std::string* path :
       {&paths.input, &paths.depth, &paths.output, &paths.coc, &paths.confidence}) {
    if (!path->empty()) *path = frame_path(*path, *frame);
  }
  return paths;
}

Device open_device(const RenderOptions& o) {
  check_output_format(o.output);
  const auto group = parse_work_group(o.work_group);
  Device device = Device::open(o.device, {choice<Math>("--math", o.math, math_words)});
  if (!o.work_group.empty()) device.set_work_group(group[0], group[1]);
  if (o.memory_mib) device.set_memory(memory_bytes(o));
  return device;
}

/// Renders frame after frame and tells about each.
class SequenceRun {
 public:
  SequenceRun(const RenderOptions& options, std::size_t frame_count)
      : options_(options),
        settings_(to_settings(options)),
        bar_(frame_count, frame_count == 1 ? "frame" : "frames", !options.quiet),
        device_(open_device(options)) {}

  /// False when the frame failed and --skip-bad-frames lets the run go on.
  bool render(std::optional<int> frame, std::size_t done) {
    FrameOutcome outcome{frame, paths_of(options_, frame), "ok", "", {}};
    if (options_.skip_existing && std::filesystem::exists(outcome.paths.output)) {
      outcome.status = "skipped";
      report(outcome);
      return true;
    }
    try {
      bar_.update(done, 0);
      FrameResult result = render_file(device_, outcome.paths, settings_,
                                       [&](double share) { bar_.update(done, share); });
      outcome.report = std::move(result.report);
      last_ = std::move(result.colour);
    } catch (const Error& error) {
      outcome.status = "failed";
      outcome.error = error.what();
      if (options_.json) report(outcome);
      bar_.clear();
      if (!options_.skip_bad_frames || error.kind() == ErrorKind::device) throw;
      fmt::print(stderr, "defray: error: {}\n", error.what());
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
    show("defray: " + options_.output, to_display_window(last_, last_data_, last_display_),
         last_display_.width, last_display_.height);
  }

 private:
  void report(const FrameOutcome& outcome) {
    bar_.clear();
    if (options_.json) {
      print_json_line(outcome, device_.name());
    } else if (!options_.quiet) {
      print_text(outcome, device_.name());
    }
  }

  const RenderOptions& options_;
  RenderSettings settings_;
  ProgressBar bar_;
  Device device_;
  std::vector<Plane> last_;
  Window last_data_, last_display_;
};

int run(const RenderOptions& options) {
  const auto frames = frames_of(options);
  SequenceRun sequence(options, frames.size());
  std::size_t failed = 0;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (!sequence.render(frames[i], i)) ++failed;
  }
  if (options.show) sequence.show_last();
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
  auto options = std::make_shared<RenderOptions>();
  add_render_options(*command, *options);
  return [options] { return run(*options); };
}

}  // namespace defray::cli
