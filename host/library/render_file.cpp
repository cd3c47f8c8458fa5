// The main job: one frame from file to file.
#include <iterator>
#include <optional>

#include "base/error.h"
#include "base/stopwatch.h"
#include "defray/io.h"
#include "image/output.h"
#include "lens/coc.h"
#include "library/backend_of.h"
#include "library/budget.h"
#include "library/check_paths.h"
#include "library/frame_notes.h"
#include "library/lens_frame.h"
#include "library/source.h"
#include "library/transparent.h"
#include "methods/method.h"
#include "prediction/with_error.h"

namespace defray {
namespace {

/// The lens once more for each group of light channels: with the colour's depth and CoC, but what
/// lies behind and mixed pixels are estimated from the group's own values. Puts the planes into
/// `choice` and `planes`, to be written with the colour.
void render_light(const Source& source, Frame frame, const RenderSettings& settings,
                  const MethodSettings& method, Backend& backend, FrameReport& report,
                  ColourChoice& choice, std::vector<Plane>& planes) {
  const Values<float> alpha_before = frame.channels.back();
  const bool is_cut_out = frame.has_alpha;
  const Plane alpha = is_cut_out ? planes.back() : Plane();
  for (const LightGroup& group : source.further.light) {
    const std::vector<Plane> before =
        read_planes(source, group.channels, settings, report.light_channels, report);
    frame.channels = Planes::view(before);
    frame.has_alpha = group.has_alpha;
    std::vector<Plane> out = apply_method(frame, method, backend).colour;
    if (group.has_alpha || !is_cut_out) {
      clear_transparent(frame, out);
    } else {
      clear_transparent(frame.channels, alpha_before.host(), out, alpha);
    }
    choice.channels.insert(choice.channels.end(), group.channels.begin(), group.channels.end());
    planes.insert(planes.end(), std::make_move_iterator(out.begin()),
                  std::make_move_iterator(out.end()));
  }
}

/// Gives data channels the values of the nearest hits.
void move_data(Source& source, const std::vector<std::uint32_t>& nearest, FrameReport& report) {
  for (const int c : source.further.data) {
    report.data_channels.push_back(source.part().channels[static_cast<std::size_t>(c)]);
    source.file.move_values(source.choice.part, c, nearest);
  }
}

/// A file for it asks for what is expected.
ErrorSettings error_settings(const RenderSettings& settings, const FramePaths& paths) {
  ErrorSettings error = settings.error;
  error.wants_planes = !paths.error.empty();
  error.wants_expected |= error.wants_planes;
  return error;
}

Frame frame_of(const Source& source, const RenderSettings& settings, Backend& backend,
               FrameReport& report) {
  PinholePicture pinhole{Planes::view(source.colour), {}, report.data, report.display};
  if (settings.method.method == Method::tiltshift) {
    return lens_frame(std::move(pinhole), settings.tiltshift, backend, report);
  }
  pinhole.depth = Values<float>::view(source.depth.data(), source.depth.size());
  Frame frame = lens_frame(std::move(pinhole), report.lens, backend, report);
  note_coc(report.lens, frame.coc_quanta.host(), report.display.width, report.notes);
  return frame;
}

}  // namespace

struct FileRender::State {
  FramePaths paths;
  RenderSettings settings;
  FrameReport report = {};
  std::optional<Source> source = {};
  // What is to be written, in host memory.
  ColourChoice choice = {};
  std::vector<Plane> planes = {};
  Plane coc_px = {}, confidence = {}, tiles = {};
  std::vector<Plane> error = {};
};

FileRender::FileRender(const FramePaths& paths, const RenderSettings& settings)
    : state_(std::make_unique<State>(State{paths, settings})) {
  state_->report.paths = paths;
  state_->report.method = settings.method.method;
}

FileRender::FileRender(FileRender&&) noexcept = default;
FileRender& FileRender::operator=(FileRender&&) noexcept = default;
FileRender::~FileRender() = default;

void FileRender::read() {
  State& s = *state_;
  const std::optional<ChainSettings>& chain = s.settings.method.chain;
  check_paths(s.paths, {s.settings.camera.source, chain ? chain->aperture.image : ""});
  check_outputs(s.paths, s.settings);
  const ErrorSettings error = error_settings(s.settings, s.paths);
  validate(s.settings.method, error);
  if (s.settings.budget_ms) validate_budget(s.settings.method, error, *s.settings.budget_ms);
  Stopwatch watch;
  s.source.emplace(read_source(s.paths, s.settings, s.report));
  s.report.read_seconds = watch.lap();
}

const std::optional<ExpectedError>& FileRender::expected() const { return state_->report.expected; }

void FileRender::render(Device& device, const Progress& progress,
                        const std::optional<ExpectedError>& before) {
  State& s = *state_;
  if (!s.source) fail(ErrorKind::usage, "{}: read() comes before render()", s.paths.input);
  Backend& backend = backend_of(device);
  Stopwatch watch;
  const Frame frame = frame_of(*s.source, s.settings, backend, s.report);
  const std::string frame_class = class_of(frame, s.report);
  s.report.tuned = use_tuning(device, frame_class);
  std::optional<Budget> budget;
  if (s.settings.budget_ms) {
    budget.emplace(device, frame_class, frame.pixels(), *s.settings.budget_ms);
    s.report.budget = budget->choice();
    note_budget(budget->choice(), s.report.notes);
  }
  const MethodSettings method = budget ? budget->settings(s.settings.method) : s.settings.method;
  const bool wants_nearest = !s.source->further.data.empty();
  ErrorSettings error = error_settings(s.settings, s.paths);
  if (before) {
    error.first_quality = before->next_quality;
    error.first_cells_per_side = before->next_cells_per_side;
  }
  ResultWithError made = apply_with_error(frame, method, error, backend, wants_nearest, progress);
  MethodResult& result = made.result;
  s.report.chain = std::move(result.report);
  s.report.expected = made.expected(error);
  if (!s.paths.error.empty()) s.error = made.prediction->planes();
  note_target(s.report.expected, error, s.report.notes);
  s.choice = s.source->choice;
  s.planes = std::move(result.colour);
  clear_transparent(frame, s.planes);
  render_light(*s.source, frame, s.settings, made.settings, backend, s.report, s.choice, s.planes);
  move_data(*s.source, result.nearest, s.report);
  if (!s.paths.coc.empty()) s.coc_px = radii_px(frame.coc_quanta.host());
  if (!s.paths.tiles.empty()) s.tiles = result.tiles.picture();
  s.confidence = std::move(result.confidence);
  s.report.predict_seconds = made.predict_seconds;
  s.report.render_seconds = watch.lap() - made.predict_seconds;
  if (!budget) return;
  for (const std::string& note :
       {budget->take_notice(), budget->learn(s.report.render_seconds, *s.report.chain)}) {
    if (!note.empty()) s.report.notes.push_back(note);
  }
}

FrameResult FileRender::write() {
  State& s = *state_;
  if (s.planes.empty()) fail(ErrorKind::usage, "{}: render() comes before write()", s.paths.input);
  Stopwatch watch;
  if (s.settings.make_folders) make_folders(s.paths);
  if (!s.settings.compression.empty()) s.source->file.set_compression(s.settings.compression);
  write_picture(s.paths.output, s.source->file, s.choice, s.planes, s.settings.bits,
                s.report.notes);
  const auto write_data = [&](const std::string& path, const char* name, const Plane& plane) {
    if (!path.empty()) write_plane(path, name, s.source->file, s.source->choice.part, plane);
  };
  write_data(s.paths.coc, "coc", s.coc_px);
  write_data(s.paths.confidence, "confidence", s.confidence);
  write_data(s.paths.tiles, "tiles", s.tiles);
  if (!s.paths.error.empty()) {
    write_planes(s.paths.error, Prediction::plane_names(), s.source->file, s.source->choice.part,
                 s.error);
  }
  s.report.write_seconds = watch.lap();
  s.planes.resize(s.source->choice.channels.size());  // the picture's own
  return {std::move(s.report), std::move(s.planes)};
}

FrameReport inspect_file(const FramePaths& paths, const RenderSettings& settings) {
  FrameReport report;
  report.paths = paths;
  report.method = settings.method.method;
  read_source(paths, settings, report);
  return report;
}

FrameResult render_file(Device& device, const FramePaths& paths, const RenderSettings& settings,
                        const Progress& progress) {
  FileRender frame(paths, settings);
  frame.read();
  frame.render(device, progress);
  return frame.write();
}

}  // namespace defray
