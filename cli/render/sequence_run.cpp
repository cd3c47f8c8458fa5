#include "render/sequence_run.h"

#include <algorithm>
#include <set>
#include <system_error>

#include "image/display.h"
#include "image/output.h"
#include "image/safe_output.h"
#include "image/sequence.h"
#include "open_device.h"
#include "opencl/kernel_cache.h"
#include "render/show_session.h"
#include "standard_streams.h"

namespace defray::cli {

FramePaths paths_of(FramePaths paths, std::optional<int> frame) {
  if (!frame) return paths;
  for (std::string* path : {&paths.input, &paths.depth, &paths.output, &paths.coc,
                            &paths.confidence, &paths.tiles, &paths.error}) {
    if (!path->empty()) *path = frame_path(*path, *frame);
  }
  return paths;
}

std::vector<std::string> outputs_of(const FramePaths& paths) {
  std::vector<std::string> outputs{paths.output};
  for (const auto& [field_name, path] : paths.data_outputs()) outputs.push_back(path);
  return outputs;
}

bool is_skipped(const RenderCommand& job, std::optional<int> frame) {
  const std::vector<std::string> outputs = outputs_of(paths_of(job.paths, frame));
  return job.skip_existing &&
         std::all_of(outputs.begin(), outputs.end(),
                     [](const std::string& path) { return path.empty() || is_written(path); });
}

namespace {

Device device_of(const RenderCommand& job) {
  check_output_format(job.paths.output);
  Device device = open_device(job.device, {job.math, !job.no_tuning}, job.quiet);
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

/// What a budget or a target chose for a frame, as options that choose it by themselves.
void print_chosen(const RenderCommand& job, const FrameOutcome& outcome) {
  const FrameReport& r = outcome.report;
  const bool has_target = r.expected && r.expected->quality;
  if (!r.budget && !has_target) return;
  const std::set<std::string> chosen{"--budget-ms", "--target-db", "--strict-target", "--quality",
                                     "--rdb",       "--frames",    "--stats"};
  std::string line = render_command_line(
      job.given, [&](const std::string& name) { return chosen.contains(name); });
  const Quality quality = r.budget ? r.budget->quality : *r.expected->quality;
  line += fmt::format(" --quality {} --rdb {}", to_string(quality),
                      r.budget ? r.budget->cells_per_side : r.expected->cells_per_side);
  if (outcome.frame) line += fmt::format(" --frames {}", *outcome.frame);
  fmt::print("  the same again: {}\n", line);
}

/// The frame's camera file, where each has its own.
std::string own_camera(const RenderCommand& job, std::optional<int> frame) {
  return frame && has_frame_pattern(job.camera) ? frame_path(job.camera, *frame) : "";
}

/// Of a picture, what has just been caught, whatever it is.
Error error_in_hand(const std::string& path) {
  try {
    throw;
  } catch (const Error& error) {
    return error;
  } catch (const std::bad_alloc&) {
    return Error(ErrorKind::input, path + ": not enough memory for this picture");
  } catch (const std::exception& error) {
    return Error(ErrorKind::internal, path + ": " + error.what());
  }
}

/// Of a frame among others.
Error with_remedy(const Error& error, std::size_t frames) {
  if (frames == 1 || error.kind() != ErrorKind::input) return error;
  return Error(error.kind(), error.marked() + "; --skip-bad-frames leaves such frames out");
}

}  // namespace

SequenceRun::SequenceRun(const RenderCommand& job, std::vector<std::optional<int>> frames)
    : job_(job),
      frames_(std::move(frames)),
      bar_(frames_.size(), frames_.size() == 1 ? "frame" : "frames", !job.quiet) {}

template <typename Step>
void SequenceRun::Work::attempt(const Step& step) {
  if (!file || error) return;
  try {
    step();
  } catch (...) {
    error = error_in_hand(outcome.paths.input);
  }
}

SequenceRun::Work SequenceRun::read(std::optional<int> frame) const {
  Work work{{frame, paths_of(job_.paths, frame), "ok", "", {}}, nullptr, {}, {}};
  if (is_skipped(job_, frame)) {
    work.outcome.status = "skipped";
    return work;
  }
  try {
    work.file = std::make_unique<FileRender>(work.outcome.paths, settings_at(job_, frame));
    work.file->read();
  } catch (...) {
    work.error = error_in_hand(work.outcome.paths.input);
  }
  return work;
}

void SequenceRun::render() {
  const auto read_ahead = [&](std::size_t i) {
    return std::async(job_.no_overlap ? std::launch::deferred : std::launch::async,
                      [this, i] { return read(frames_[i]); });
  };
  prepare_environment();
  std::future<Work> reading = read_ahead(0), writing;
  device_.emplace(device_of(job_));
  for (std::size_t i = 0; i < frames_.size(); ++i) {
    Work work = reading.get();
    if (i + 1 < frames_.size()) reading = read_ahead(i + 1);
    work.attempt([&] {
      bar_.update(i, 0);
      work.file->render(
          *device_, [&](double share) { bar_.update(i, share); }, before_);
      before_ = work.file->expected();
    });
    if (writing.valid()) finish(writing.get());
    if (!work.file || work.error) {
      finish(std::move(work));
      continue;
    }
    writing = std::async(std::launch::async, [work = std::move(work)]() mutable {
      work.attempt([&] {
        FrameResult result = work.file->write();
        work.outcome.report = std::move(result.report);
        work.colour = std::move(result.colour);
      });
      return std::move(work);
    });
    if (job_.no_overlap) finish(writing.get());
  }
  if (writing.valid()) finish(writing.get());
}

void SequenceRun::finish(Work work) {
  if (work.error) {
    work.outcome.status = "failed";
    work.outcome.error = job_.named(message_of(*work.error));
    if (job_.json) report(work.outcome);
    bar_.clear();
    if (work.error->kind() == ErrorKind::device) throw *work.error;
    if (!job_.skip_bad_frames) throw with_remedy(*work.error, frames_.size());
    fmt::print(stderr, "defray: error: {}\n", work.outcome.error);
    ++failed_;
    return;
  }
  const std::optional<ExpectedError>& expected = work.outcome.report.expected;
  if (expected && expected->misses_target) ++missed_;
  if (work.file) {
    last_ = std::move(work.colour);
    last_data_ = work.outcome.report.data;
    last_display_ = work.outcome.report.display;
  }
  report(std::move(work.outcome));
}

void SequenceRun::show_last() {
  std::string why;
  if (last_.empty()) return;
  if (!has_display(why)) {
    fmt::print(stderr, "defray: --show skipped: {}\n", why);
    return;
  }
  bar_.clear();
  ShowSession session(job_, frames_, *device_);
  session.run(to_display_window(last_, last_data_, last_display_));
  fmt::print(job_.quiet || job_.json ? stderr : stdout, "{}\n", session.command());
}

void SequenceRun::report(FrameOutcome outcome) {
  bar_.clear();
  if (is_mute_) return;
  FrameReport& about = outcome.report;
  for (FramePaths* paths : {&outcome.paths, &about.paths}) {
    paths->input = job_.named(paths->input);
    paths->output = job_.named(paths->output);
  }
  for (std::string& note : about.notes) note = job_.named(note);
  try {
    if (job_.json) {
      print_json_line(outcome, device_->name());
    } else if (!job_.quiet) {
      print_text(outcome, notes_.take(notes_of(about), own_camera(job_, outcome.frame)),
                 device_->name());
      if (job_.stats && outcome.status == "ok") {
        print_stats(outcome.report);
        print_chosen(job_, outcome);
      }
    }
    is_mute_ = !flush_output();         // a log shows each frame as it is done
  } catch (const std::system_error&) {  // fmt's: the pictures are what counts
    is_mute_ = true;
    flush_output();
  }
}

}  // namespace defray::cli
