// defray splat: a point cloud through the lens.
#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/stopwatch.h"
#include "base/text.h"
#include "base/vec3.h"
#include "commands.h"
#include "image/display.h"
#include "image/output.h"
#include "image/safe_output.h"
#include "image/sequence.h"
#include "image/viewer.h"
#include "lens/camera.h"
#include "open_device.h"
#include "options/camera_file.h"
#include "progress.h"
#include "splat/splat_command.h"
#include "splat/splat_report.h"

namespace defray::cli {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

constexpr const char* splat_footer =
    R"(Lens, focus and units are those of 'defray render': focus and places in scene units (--unit says what
one is); focal length, sensor and aperture in millimetres; the picture is as wide as the sensor.

Examples:
  defray splat scan.ply -o out.exr --fstop 2.8 --focal-length 50
  defray splat scan.ply -o out.exr --from 1,2,5 --look-at 0,1,0 --focus 4.2 --fstop 1.4 --fov 40 --focal-length 50
  defray splat --model figure -o turn.####.exr --turntable 36 --size 512x512 --fstop 2 --focal-length 50)";

Vec3 vec(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }

SplatModel model_of(const SplatCommand& job, bool has_bar) {
  if (job.input.empty() == job.model.empty()) {
    fail(ErrorKind::usage, "a point cloud is missing: name a file, or a model with --model");
  }
  ProgressBar bar(1, "points", has_bar);
  const auto update = [&](double share) { bar.update(0, share); };
  return job.model.empty() ? SplatModel::read(job.input, job.has_cache, update)
                           : SplatModel(make_point_cloud(job.model, job.model_points), update);
}

/// Options win over the camera file's pose, and that over the default.
CameraPose pose_of(const SplatCommand& job, const SplatModel& model, const Lens& lens) {
  CameraPose pose = framing_pose(model, lens, job.settings);
  if (!job.camera_file.empty()) {
    if (const auto stated = read_camera_pose(job.camera_file, job.metres_per_unit)) pose = *stated;
  }
  const Vec3 back = vec(pose.from) - vec(pose.look_at);
  if (job.look_at) {
    pose.look_at = *job.look_at;
    const Vec3 from = vec(pose.look_at) + back;
    pose.from = {from.x, from.y, from.z};
  }
  if (job.from) pose.from = *job.from;
  if (job.up) pose.up = *job.up;
  return pose;
}

/// The lens; without a focus it is on what is looked at, `focus` away.
Lens lens_of(const SplatCommand& job, double focus) {
  CameraValues values = job.camera;
  if (!values.focus_distance_units) values.focus_distance_units = focus;
  const Window display{0, 0, job.settings.width, job.settings.height};
  return make_lens(values, job.metres_per_unit, LensModel::cg, 0, display);
}

/// Turned about `up` through what is looked at, by a part of a turn.
CameraPose turned(CameraPose pose, double share) {
  if (share == 0) return pose;
  const double angle = 2 * M_PI * share;
  const Vec3 axis = normalized(vec(pose.up)), arm = vec(pose.from) - vec(pose.look_at);
  const Vec3 from = vec(pose.look_at) + arm * std::cos(angle) + cross(axis, arm) * std::sin(angle) +
                    axis * (dot(axis, arm) * (1 - std::cos(angle)));
  pose.from = {from.x, from.y, from.z};
  return pose;
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

/// Before the points are read: what is asked for, and the camera file.
void check(SplatCommand& job) {
  check_output_format(job.output);
  check_can_write(job.turntable > 0 ? frame_path(job.output, 1) : job.output);
  if (job.turntable < 0)
    fail(ErrorKind::usage, "--turntable is {}: allowed are 1 on", job.turntable);
  if (job.turntable > 0 && !has_frame_pattern(job.output)) {
    fail(ErrorKind::usage, "{}: {} frames would go to one file; put #### in its name", job.output,
         job.turntable);
  }
  if (!job.camera_file.empty()) {
    job.camera = read_camera_file(job.camera_file, job.focus_setting, job.metres_per_unit)
                     .overridden_by(job.camera);
  }
  lens_of(job, infinity);  // what is looked at is not known yet
}

int run(SplatCommand& job) {
  check(job);
  Device device = open_device(job.device, {Math::strict, !job.no_tuning}, job.quiet);
  const bool has_bar = !job.quiet && !job.json;
  const SplatModel model = model_of(job, has_bar);
  for (const std::string& note : model.notes()) fmt::print(stderr, "defray: note: {}\n", note);
  const CameraPose start = pose_of(job, model, lens_of(job, infinity));
  const double distance = length(vec(start.look_at) - vec(start.from));
  const Lens lens = lens_of(job, distance > 0 ? distance : 1);
  const int frames = std::max(1, job.turntable);
  std::vector<Plane> last;
  for (int i = 0; i < frames; ++i) {
    const CameraPose pose = turned(start, static_cast<double>(i) / frames);
    const std::string path = job.turntable > 0 ? frame_path(job.output, i + 1) : job.output;
    ProgressBar bar(size(frames), "frames", has_bar);
    Stopwatch watch;
    SplatResult result = splat(device, model, pose, lens, job.settings,
                               [&](double share) { bar.update(size(i), share); });
    const double seconds = watch.seconds();
    const std::vector<std::string> notes = write(path, job, result);
    bar.clear();
    if (job.json) {
      print_json(path, lens, pose, result.report, seconds);
    } else if (!job.quiet) {
      print_text(path, lens, result.report, seconds, device);
      for (const std::string& note : notes) fmt::print("  {}\n", note);
    }
    last = std::move(result.colour);
  }
  if (job.show) show(last, job.settings, job.output);
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
