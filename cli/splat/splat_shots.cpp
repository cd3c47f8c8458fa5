#include "splat/splat_shots.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/vec3.h"
#include "image/sequence.h"
#include "lens/camera.h"
#include "options/camera_file.h"
#include "options/lens_rows.h"

namespace defray::cli {
namespace {

Vec3 vec(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }

std::vector<int> turn_frames(const SplatCommand& job) {
  if (has_frame_pattern(job.camera_file)) {
    fail(ErrorKind::usage, "--turntable goes round with one camera, {} are many: give one of them",
         job.camera_file);
  }
  std::vector<int> frames;
  for (int i = 1; i <= job.turntable; ++i) frames.push_back(i);
  if (job.frames.empty()) return frames;
  const std::vector<int> asked = parse_frames(job.frames);
  for (const int frame : asked) {
    if (frame >= 1 && frame <= job.turntable) continue;
    fail(ErrorKind::usage, "--frames has {}: the turn's frames are 1 to {}", frame, job.turntable);
  }
  return asked;
}

/// None: a picture without a number.
std::vector<std::optional<int>> frames_of(const SplatCommand& job) {
  std::vector<int> frames;
  if (job.turntable > 0) {
    frames = turn_frames(job);
  } else if (!job.frames.empty()) {
    frames = parse_frames(job.frames);
  } else if (has_frame_pattern(job.camera_file)) {
    frames = find_frames(job.camera_file);
  } else if (has_frame_pattern(job.output)) {
    fail(ErrorKind::usage,
         "{}: has a frame pattern, and one picture is asked for: --turntable or --frames say more",
         job.output);
  } else {
    return {std::nullopt};
  }
  if (frames.size() > 1 && !has_frame_pattern(job.output)) {
    fail(ErrorKind::usage, "{}: {} frames would go to one file; give a name with ####", job.output,
         frames.size());
  }
  return {frames.begin(), frames.end()};
}

SplatShot shot_of(const SplatCommand& job, std::optional<int> frame) {
  FrameLens lens{job.camera, {}, job.eye, job.max_coc_px};
  for (const AnimatedValue& value : job.animated) {
    if (!frame) {
      fail(ErrorKind::usage, "{} changes over frames: say which, with --frames", value.option);
    }
    value.set(lens, value.curve.at(*frame));
  }
  SplatShot shot{frame,
                 frame ? frame_path(job.output, *frame) : job.output,
                 eye_of(lens.eye).overridden_by(lens.camera),
                 lens.max_coc_px,
                 {}};
  const std::string of_eye = note_on_eye(lens.eye, lens.camera);
  if (!of_eye.empty()) shot.camera.notes.push_back(of_eye);
  if (job.camera_file.empty()) return shot;
  const std::string file = frame ? frame_path(job.camera_file, *frame) : job.camera_file;
  shot.camera =
      read_camera_json(file, job.focus_setting, job.metres_per_unit).overridden_by(shot.camera);
  for (std::string& note : shot.camera.notes) note = beside_render(note);
  shot.stated = read_camera_pose(file, job.metres_per_unit);
  return shot;
}

/// Without a focus it is on what is looked at, `focus` away. A field of view alone is that of a
/// camera whose sensor is as wide as the default one; without one the focal length is the default
/// one.
CameraValues values_of(const SplatShot& shot, double focus) {
  CameraValues values = shot.camera;
  if (!values.focal_length_mm) {
    const double fov = values.fov_deg.value_or(0);  // make_lens says what is wrong with others
    values.focal_length_mm = fov > 0 && fov < 180
                                 ? Lens().sensor_width_mm / 2 / std::tan(fov * M_PI / 360)
                                 : Lens().focal_length_mm;
  }
  if (!values.focus_distance_units) values.focus_distance_units = focus;
  return values;
}

Lens lens_of(const SplatCommand& job, const SplatShot& shot, double focus) {
  const Window display{0, 0, job.settings.width, job.settings.height};
  return make_lens(values_of(shot, focus), job.metres_per_unit, LensModel::cg, shot.max_coc_px,
                   display);
}

/// What is wrong with it is said before points are read.
void check_lens(const SplatCommand& job, SplatShot shot) {
  if (!shot.camera.focus_distance_units) shot.camera.perceived_distance_m.reset();
  lens_of(job, shot, std::numeric_limits<double>::infinity());
}

CameraPose pose_of(const SplatCommand& job, const SplatShot& shot, const SplatModel& model,
                   const Lens& lens) {
  CameraPose pose = shot.stated ? *shot.stated : framing_pose(model, lens, job.settings);
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

}  // namespace

std::vector<SplatShot> shots_of(const SplatCommand& job) {
  std::vector<SplatShot> shots;
  for (const std::optional<int>& frame : frames_of(job)) {
    check_lens(job, shots.emplace_back(shot_of(job, frame)));
  }
  return shots;
}

SplatCamera camera_of(const SplatCommand& job, const SplatShot& shot, const SplatModel& model) {
  SplatShot unfocused = shot;
  unfocused.camera.perceived_distance_m.reset();
  const Lens far = lens_of(job, unfocused, std::numeric_limits<double>::infinity());
  const CameraPose start = pose_of(job, shot, model, far);
  const double distance = length(vec(start.look_at) - vec(start.from));
  const double share = job.turntable > 0 ? static_cast<double>(*shot.frame - 1) / job.turntable : 0;
  const double focus = distance > 0 ? distance : 1;
  std::vector<std::string> notes = shot.camera.notes;
  for (std::string& note : notes_on_extremes(values_of(shot, focus))) {
    notes.push_back(std::move(note));
  }
  return {turned(start, share), lens_of(job, shot, focus), std::move(notes)};
}

}  // namespace defray::cli
