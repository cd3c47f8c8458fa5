#include "splat/splat_run.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "base/stopwatch.h"
#include "base/text.h"
#include "image/output.h"
#include "image/safe_output.h"
#include "image/sequence.h"
#include "library/frame_notes.h"

namespace defray::cli {
namespace {

/// Of a closed surface half is seen from behind; of the built-in models' parts never so much.
constexpr double mostly_behind = 0.9;
/// Less of it is a few normals that point the other way.
constexpr double partly_behind = 0.1;
/// With less blur, or of less of the surface, it is hardly seen that the back shows.
constexpr double least_open = 0.1, least_coc_px = 2;

/// Returns notes on the file.
std::vector<std::string> write_splats(const std::string& path, const SplatCommand& job,
                                      const SplatResult& result) {
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  if (job.makes_folders && !folder.empty()) create_folder(folder.string());
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

/// Why a picture is empty.
std::string note_of_nothing(const CameraPose& pose, const SplatModel& model) {
  const std::array<double, 3> centre = model.centre();
  double ahead = 0, square = 0;  // of the centre, times the length of what the camera looks along
  for (std::size_t k = 0; k < 3; ++k) {
    const double along = pose.look_at[k] - pose.from[k];
    ahead += (centre[k] - pose.from[k]) * along;
    square += along * along;
  }
  const bool is_behind = ahead < -model.radius() * std::sqrt(square);
  return fmt::format(
      "nothing of the cloud is seen: it lies {}: see --from, --look-at",
      is_behind ? "behind the camera" : "beside the picture, or is seen from its edge");
}

/// What to know about a picture; `written` about its file.
std::vector<std::string> splat_notes(const SplatCamera& camera, const SplatModel& model,
                                     const SplatReport& report, const SplatSettings& settings,
                                     const std::vector<std::string>& written) {
  std::vector<std::string> notes = camera.notes;
  notes.insert(notes.end(), written.begin(), written.end());
  const double coc = std::max(std::abs(report.nearest_coc_px), std::abs(report.farthest_coc_px));
  if (report.seen > 0) note_small_coc(camera.lens, coc, notes);
  if (model.open_share() > least_open && coc > least_coc_px) {
    notes.push_back(fmt::format(
        "{:.0f} % of the surface has no normals and is not closed, and is seen from both sides: "
        "where its back is near, blurred outlines are too solid; normals in the file mend that",
        100 * model.open_share()));
  }
  if (report.spilled > 0) {
    notes.push_back(fmt::format(
        "{} pixel{} ha{} more than --layers {} surfaces to be seen: what lies behind those is left "
        "out",
        report.spilled, report.spilled == 1 ? "" : "s", report.spilled == 1 ? "s" : "ve",
        settings.layers));
  }
  if (report.from_behind > mostly_behind) {
    notes.push_back(fmt::format(
        "{:.0f} % of what is before the camera is seen from behind and not drawn: --two-sided "
        "draws it; normals may point inwards",
        100 * report.from_behind));
  } else if (report.seen == 0) {
    notes.push_back(note_of_nothing(camera.pose, model));
  } else if (report.is_inside_out && report.from_behind > partly_behind) {
    notes.push_back(fmt::format(
        "{:.0f} % of what is before the camera is seen from behind and not drawn, and lies before "
        "what is: normals may point inwards; --two-sided draws both",
        100 * report.from_behind));
  }
  return notes;
}

}  // namespace

bool is_skipped(const SplatCommand& job, const SplatShot& shot) {
  return job.skip_existing && is_written(shot.output);
}

SplatRun::SplatRun(const SplatCommand& job, Device& device, const SplatModel& model,
                   std::string source, double ready_seconds)
    : job_(job),
      device_(device),
      model_(model),
      source_(std::move(source)),
      ready_seconds_(ready_seconds) {}

void SplatRun::draw(const std::vector<SplatShot>& shots) {
  ProgressBar bar(shots.size(), "frames", !job_.quiet && !job_.json);
  std::future<WrittenSplats> writing;
  const auto finish_last = [&] {
    if (!writing.valid()) return;
    bar.clear();
    finish(writing);
  };
  for (std::size_t i = 0; i < shots.size(); ++i) {
    if (is_skipped(job_, shots[i])) {
      finish_last();
      bar.clear();
      print_skipped(job_, shots[i]);
      continue;
    }
    const SplatCamera camera = camera_of(job_, shots[i], model_);
    const Stopwatch watch;
    SplatResult result = splat(device_, model_, camera.pose, camera.lens, job_.settings,
                               [&](double share) { bar.update(i, share); });
    const double seconds = watch.seconds();
    finish_last();
    writing = write_later(shots[i], camera, std::move(result), seconds);
    ready_seconds_ = 0;
  }
  finish_last();
}

std::future<WrittenSplats> SplatRun::write_later(const SplatShot& shot, SplatCamera camera,
                                                 SplatResult result, double seconds) const {
  return std::async(std::launch::async, [=, this, result = std::move(result),
                                         ready_seconds = ready_seconds_]() mutable {
    const std::vector<std::string> notes = write_splats(shot.output, job_, result);
    SplatOutcome outcome{source_,
                         device_.name(),
                         camera,
                         result.report,
                         ready_seconds,
                         seconds,
                         splat_notes(camera, model_, result.report, job_.settings, notes)};
    if (job_.json) {  // as text they were printed before the first
      const std::vector<std::string>& of_cloud = model_.notes();
      outcome.notes.insert(outcome.notes.begin(), of_cloud.begin(), of_cloud.end());
    }
    return WrittenSplats{shot, std::move(outcome), std::move(result.colour)};
  });
}

void SplatRun::finish(std::future<WrittenSplats>& writing) {
  const WrittenSplats& written = last_.emplace(writing.get());
  if (job_.json) {
    print_json(written.shot, written.outcome);
  } else if (!job_.quiet) {
    const bool has_own_camera = written.shot.frame && has_frame_pattern(job_.camera_file);
    print_text(
        written.shot, written.outcome,
        notes_.take(written.outcome.notes,
                    has_own_camera ? frame_path(job_.camera_file, *written.shot.frame) : ""));
  }
}

}  // namespace defray::cli
