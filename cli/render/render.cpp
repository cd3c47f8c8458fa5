// defray render: one picture or a sequence through the lens.
#include "commands.h"
#include "defray/defray.h"
#include "exit_code.h"
#include "image/sequence.h"
#include "render/render_command.h"
#include "render/sequence_run.h"

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
std::vector<std::optional<int>> frames_of(const RenderCommand& job) {
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

int run(const OptionTable& options, RenderCommand& job) {
  options.set();
  const auto frames = frames_of(job);
  options.refuse_idle({job.settings.method.method, job.is_literal, job.is_on_reference()});
  finish(job);
  SequenceRun sequence(job, frames);
  const std::size_t failed = sequence.render();
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
  const auto job = std::make_shared<RenderCommand>();
  const OptionTable options(*command, render_options(*job));
  return [options, job] { return run(options, *job); };
}

}  // namespace defray::cli
