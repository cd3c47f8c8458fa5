// defray splat: a point cloud through the lens.
#include "base/error.h"
#include "base/stopwatch.h"
#include "base/text.h"
#include "commands.h"
#include "image/display.h"
#include "image/output.h"
#include "image/safe_output.h"
#include "image/sequence.h"
#include "image/viewer.h"
#include "open_device.h"
#include "progress.h"
#include "splat/splat_report.h"
#include "splat/splat_shots.h"
#include "standard_streams.h"

namespace defray::cli {
namespace {

/// Of a closed surface half is seen from behind; of the built-in models' parts never so much.
constexpr double mostly_behind = 0.9;

constexpr const char* splat_footer =
    R"(Lens, focus and units are those of 'defray render': focus and places in scene units (--unit says what
one is); focal length (50 unless given), sensor and aperture in millimetres; the picture is as wide as the sensor.

Examples:
  defray splat scan.ply -o out.exr --fstop 2.8
  defray splat scan.ply -o out.exr --from 1,2,5 --look-at 0,1,0 --focus 4.2 --fstop 1.4 --fov 40
  defray splat --model figure -o turn.####.exr --turntable 36 --size 512x512 --fstop 2 --focal-length 50)";

SplatModel model_of(const SplatCommand& job, bool has_bar) {
  if (job.input.empty() == job.model.empty()) {
    fail(ErrorKind::usage, "a point cloud is missing: name a file, or a model with --model");
  }
  std::error_code unknown;
  if (has_frame_pattern(job.input) && !std::filesystem::exists(job.input, unknown)) {
    fail(ErrorKind::usage,
         "{}: one cloud goes with all frames: a pattern is for cameras and pictures", job.input);
  }
  ProgressBar bar(1, "points", has_bar);
  const auto update = [&](double share) { bar.update(0, share); };
  return job.model.empty() ? SplatModel::read(job.input, job.has_cache, update)
                           : SplatModel(make_point_cloud(job.model, job.model_points), update);
}

std::vector<std::string> write(const std::string& path, const SplatCommand& job,
                               const SplatResult& result) {
  std::vector<std::string> names{"R", "G", "B", "A"};
  std::vector<Plane> planes = result.colour;
  if (job.has_depth) {
    names.push_back("Z");
    planes.push_back(result.depth);
  }
  if (job.has_fragments) {
    names.push_back("fragments");
    planes.push_back(result.fragments);
  }
  ImageFile file = ImageFile::from_planes(names, planes, job.settings.width, job.settings.height,
                                          Sample::single_float);
  std::vector<std::string> notes;
  if (lower_extension(path) == ".exr") {
    write_safely(path, [&](const std::string& name) { file.write(name); });
    return notes;
  }
  write_picture(path, file, {0, "", "", {0, 1, 2, 3}}, result.colour, Bits::as_input, notes);
  return notes;
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

/// What to know about a picture; `written` about its file.
std::vector<std::string> notes_of(const SplatReport& report, std::vector<std::string> written) {
  std::vector<std::string> notes = std::move(written);
  if (report.from_behind > mostly_behind) {
    notes.push_back(fmt::format(
        "{:.0f} % of what is before the camera is seen from behind and not drawn: --two-sided "
        "draws it; normals may point inwards",
        100 * report.from_behind));
  } else if (report.seen == 0) {
    notes.push_back("nothing of the cloud is in the picture: see --from, --look-at");
  }
  return notes;
}

void report(const SplatCommand& job, const SplatShot& shot, const SplatOutcome& outcome) {
  if (!job.quiet) {
    for (const std::string& note : outcome.notes) {
      print_error(fmt::format("defray: note: {}: {}", shot.output, note));
    }
  }
  if (job.json) {
    print_json(shot, outcome);
  } else if (!job.quiet) {
    print_text(shot, outcome);
  }
}

int run(const SplatCommand& job) {
  check_output_format(job.output);
  const std::vector<SplatShot> shots = shots_of(job);
  check_can_write(shots.front().output);
  Device device = open_device(job.device, {Math::strict, !job.no_tuning}, job.quiet);
  const bool has_bar = !job.quiet && !job.json;
  const SplatModel model = model_of(job, has_bar);
  const std::string source = job.input.empty() ? "model " + job.model : job.input;
  for (const std::string& note : model.notes())
    print_error("defray: note: " + source + ": " + note);
  std::vector<Plane> last;
  for (std::size_t i = 0; i < shots.size(); ++i) {
    const SplatShot& shot = shots[i];
    const SplatCamera camera = camera_of(job, shot, model);
    ProgressBar bar(shots.size(), "frames", has_bar);
    const Stopwatch watch;
    SplatResult result = splat(device, model, camera.pose, camera.lens, job.settings,
                               [&](double share) { bar.update(i, share); });
    const double seconds = watch.seconds();
    const std::vector<std::string> written = write(shot.output, job, result);
    bar.clear();
    report(
        job, shot,
        {source, device.name(), camera, result.report, seconds, notes_of(result.report, written)});
    last = std::move(result.colour);
  }
  if (job.show) show(last, job.settings, "defray: " + shots.back().output);
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
