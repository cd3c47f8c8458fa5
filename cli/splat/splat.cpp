// defray splat: a point cloud through the lens.
#include <algorithm>
#include <filesystem>

#include "base/error.h"
#include "base/stopwatch.h"
#include "commands.h"
#include "image/display.h"
#include "image/output.h"
#include "image/safe_output.h"
#include "image/sequence.h"
#include "image/viewer.h"
#include "open_device.h"
#include "progress.h"
#include "splat/splat_run.h"
#include "splat/view.h"
#include "standard_streams.h"

namespace defray::cli {
namespace {

constexpr const char* splat_footer =
    R"(Lens, focus and units are those of 'defray render': focus and places in scene units (--unit says what
one is); focal length (50 unless given), sensor and aperture in millimetres; the picture is as wide as the sensor.

Examples:
  defray splat scan.ply -o out.exr --aperture-diameter 300
  defray splat scan.ply -o out.exr --from 1,2,5 --look-at 0,1,0 --focus 4.2 --fstop 0.2 --fov 40
  defray splat --model figure -o turn.####.exr --turntable 36 --size 512x512 --fstop 0.2 --focal-length 50)";

void check_source(const SplatCommand& job) {
  if (job.input.empty() == job.model.empty()) {
    fail(ErrorKind::usage, "a point cloud is missing: name a file, or a model with --model");
  }
  std::error_code unknown;
  if (has_frame_pattern(job.input) && !std::filesystem::exists(job.input, unknown)) {
    fail(ErrorKind::usage,
         "{}: one cloud goes with all frames: a pattern is for cameras and pictures", job.input);
  }
}

SplatModel model_of(const SplatCommand& job, bool has_bar) {
  ProgressBar bar(1, "clouds", has_bar);
  const auto update = [&](double share) { bar.update(0, share); };
  try {
    return job.model.empty() ? SplatModel::read(job.input, job.has_cache, update)
                             : SplatModel(make_point_cloud(job.model, job.model_points), update);
  } catch (const std::bad_alloc&) {
    fail(ErrorKind::input, "{}: not enough memory for so many points: thin it out, or split it",
         job.model.empty() ? job.input : "model " + job.model);
  }
}

void show(const std::vector<Plane>& colour, const SplatSettings& s, const std::string& title) {
  std::string why;
  if (!has_display(why)) {
    fmt::print(stderr, "defray: --show skipped: {}\n", why);
    return;
  }
  Viewer viewer(title, s.width, s.height);
  while (true) {
    viewer.show(colour, s.width, s.height, false, title);
    const ViewerEvent event = viewer.wait();
    const bool is_end = event.key == 'q' || event.key == key_escape;
    if (event.kind == ViewerEvent::Kind::closed || is_end) return;
  }
}

void check_place(const SplatCommand& job, const SplatShot& shot) {
  if (job.makes_folders) {
    check_can_make(shot.output);
  } else {
    check_can_write(shot.output, "--mkdir makes it");
  }
}

int run(const SplatCommand& job) {
  check_output_format(job.output);
  check_source(job);
  validate(job.settings);
  const std::vector<SplatShot> shots = shots_of(job);
  const auto is_left = [&](const SplatShot& shot) { return is_skipped(job, shot); };
  if (std::all_of(shots.begin(), shots.end(), is_left)) {
    for (const SplatShot& shot : shots) print_skipped(job, shot);
    return 0;
  }
  check_place(job, *std::find_if_not(shots.begin(), shots.end(), is_left));
  Device device = open_device(job.device, {Math::strict, !job.no_tuning}, job.quiet);
  const Stopwatch watch;
  const SplatModel model = model_of(job, !job.quiet && !job.json);
  const double ready_seconds = watch.seconds();
  const std::string source = job.input.empty() ? "model " + job.model : job.input;
  if (!job.quiet) {
    for (const std::string& note : model.notes()) {
      print_error("defray: note: " + source + ": " + note);
    }
  }
  SplatRun splats(job, device, model, source, ready_seconds);
  splats.draw(shots);
  if (const auto& last = splats.last(); job.show && last) {
    show(last->colour, job.settings, "defray: " + last->shot.output);
  }
  return 0;
}

}  // namespace

Run add_splat(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "splat", "Render a point cloud through the lens: surface splatting with depth of field");
  command->footer(splat_footer);
  const auto job = std::make_shared<SplatCommand>();
  const OptionTable options(*command, splat_options(*job));
  return [options, job] {
    options.set();
    options.refuse_idle();
    return run(*job);
  };
}

}  // namespace defray::cli
