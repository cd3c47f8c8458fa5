// defray render: one picture or a sequence through the lens.
#include <filesystem>

#include "commands.h"
#include "defray/defray.h"
#include "exit_code.h"
#include "image/sequence.h"
#include "render/render_command.h"
#include "render/sequence_run.h"
#include "standard_streams.h"

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

/// Whether a name stands for numbered files. Beside a single picture an @ is a letter: hero@2x.png.
bool is_pattern(const RenderCommand& job, const std::string& name, bool is_sequence) {
  if (job.no_pattern || name.empty() || !has_frame_pattern(name)) return false;
  return is_sequence || name.find_first_of("#%", name.rfind('/') + 1) != std::string::npos;
}

/// The frames to render; a single empty one for a picture without a pattern.
std::vector<std::optional<int>> frames_of(const RenderCommand& job) {
  const FramePaths& p = job.paths;
  const bool is_sequence = is_pattern(job, p.input, true);
  if (!is_sequence) {
    if (!job.frames.empty()) {
      fail(ErrorKind::usage, "--frames needs a pattern in the input name, such as shot.####.exr");
    }
    if (job.focus_frame) {
      fail(ErrorKind::usage, "--focus-frame needs a pattern in the input name: {} is one picture",
           p.input);
    }
    if (is_pattern(job, job.camera, false)) {
      fail(
          ErrorKind::usage,
          "--camera {}: is one a frame, the input {} is one picture: put #### in its name, or give "
          "the camera of its frame",
          job.camera, p.input);
    }
    for (const std::string& name : outputs_of(p)) {
      if (is_pattern(job, name, false)) {
        fail(ErrorKind::usage,
             "{}: has a frame pattern, the input {} has none{}; --no-pattern takes it as a name",
             name, p.input, p.input.find('*') == std::string::npos ? "" : ": write #### for its *");
      }
    }
    return {std::nullopt};
  }
  const std::vector<int> numbers =
      job.frames.empty() ? find_frames(p.input) : parse_frames(job.frames);
  const std::string gaps = job.frames.empty() ? gaps_between(numbers) : "";
  if (!gaps.empty() && !job.quiet) {
    print_error(fmt::format("defray: note: {}: no frame {}", p.input, gaps));
  }
  for (const std::string& name : outputs_of(p)) {
    if (numbers.size() > 1 && !name.empty() && !has_frame_pattern(name)) {
      fail(ErrorKind::usage,
           "{}: {} frames would go to one file; give a name with ####, or one of them: --frames {}",
           name, numbers.size(), numbers.front());
    }
  }
  return {numbers.begin(), numbers.end()};
}

/// A link is there, wherever it leads: to a frame that is still to be written, for one.
bool is_missing(const std::string& path) {
  std::error_code unknown;
  const auto status = std::filesystem::symlink_status(path, unknown);
  return status.type() == std::filesystem::file_type::not_found;
}

/// A file a frame: that one is missing must not show hours later.
void check_frame_files(const RenderCommand& job, const std::vector<std::optional<int>>& frames) {
  if (job.skip_bad_frames || frames.size() == 1) return;
  const std::pair<const char*, std::string> patterns[] = {
      {"picture", job.paths.input}, {"depth", job.paths.depth}, {"camera", job.camera}};
  for (const auto& [what, pattern] : patterns) {
    if (!has_frame_pattern(pattern)) continue;
    std::vector<std::string> missing;
    for (const std::optional<int>& frame : frames) {
      const std::string path = frame_path(pattern, *frame);
      if (is_missing(path) && !is_skipped(job, frame)) missing.push_back(path);
    }
    if (missing.empty()) continue;
    fail(ErrorKind::input,
         "{}: no such file: {} of {} frames have no {}; --skip-bad-frames leaves them out",
         missing.front(), missing.size(), frames.size(), what);
  }
}

/// The focus of --focus-frame, for all frames.
void take_focus_of_frame(RenderCommand& job) {
  if (!job.focus_frame) return;
  job.settings.camera.focus_distance_units =
      inspect_file(paths_of(job.paths, job.focus_frame), settings_at(job, job.focus_frame))
          .lens.focus_distance_units;
  job.settings.focus_at.reset();
}

/// Says what is not as it was asked for.
int exit_code_of(const SequenceRun& sequence, const RenderCommand& job, std::size_t frames) {
  const std::size_t failed = sequence.failed();
  if (failed > 0) fmt::print(stderr, "defray: error: {} of {} frames failed\n", failed, frames);
  const std::size_t missed = job.strict_target ? sequence.missed() : 0;
  if (missed > 0) {
    fmt::print(stderr, "defray: error: {} of {} frames miss --target-db {}\n", missed, frames,
               *job.settings.error.target_db);
  }
  return failed + missed > 0 ? ExitCode::failed : ExitCode::ok;
}

int run(const OptionTable& options, RenderCommand& job) {
  options.set();
  job.given = options.given();
  PictureStreams streams(job.paths.input, job.paths.output);
  job.named = [&](const std::string& text) { return streams.named(text); };
  try {
    const auto frames = frames_of(job);
    options.refuse_idle({job.settings.method.method, job.is_literal, job.is_on_reference()});
    finish(job);
    check_lens(job, frames);
    check_frame_files(job, frames);
    take_focus_of_frame(job);
    SequenceRun sequence(job, frames);
    sequence.render();
    streams.finish();
    if (job.show) sequence.show_last();
    return exit_code_of(sequence, job, frames.size());
  } catch (const Error& error) {
    throw Error(error.kind(), streams.named(error.marked()));
  }
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
