// The main job: one frame from file to file.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <optional>

#include "base/error.h"
#include "base/stopwatch.h"
#include "defray/io.h"
#include "image/depth_plane.h"
#include "image/further_channels.h"
#include "image/nonfinite.h"
#include "image/output.h"
#include "image/safe_output.h"
#include "lens/camera.h"
#include "lens/coc.h"
#include "lens/depth.h"
#include "library/backend_of.h"
#include "render.h"

namespace defray {
namespace {

/// A picture read, ready for the lens.
struct Source {
  ImageFile file;
  ColourChoice choice;
  std::vector<Plane> colour;
  Plane depth;
  FurtherChannels further = {};
  const PartInfo& part() const { return file.parts()[static_cast<std::size_t>(choice.part)]; }
};

/// `also_read`: further files that must stay as they are.
void check_paths(const FramePaths& paths, const std::vector<std::string>& also_read) {
  std::error_code ignored;
  for (const std::string& output : {paths.output, paths.coc, paths.confidence, paths.tiles}) {
    if (output.empty()) continue;
    std::vector<std::string> inputs = also_read;
    inputs.insert(inputs.end(), {paths.input, paths.depth});
    for (const std::string& input : inputs) {
      if (!input.empty() && std::filesystem::equivalent(input, output, ignored)) {
        fail(ErrorKind::usage, "{}: is input and output at once; write to another file", output);
      }
    }
  }
  const std::pair<const char*, const std::string&> outputs[] = {{"output", paths.output},
                                                                {"coc", paths.coc},
                                                                {"confidence", paths.confidence},
                                                                {"tiles", paths.tiles}};
  for (const auto& [name, path] : outputs) {
    for (const auto& [other, other_path] : outputs) {
      if (&path == &other_path) break;
      if (!path.empty() && is_same_file(path, other_path)) {
        fail(ErrorKind::usage, "{}: {} and {} are the same file", path, field(other), field(name));
      }
    }
  }
}

/// Planes of these channels, and what was not finite in them.
std::vector<Plane> read_planes(const Source& source, const std::vector<int>& channels,
                               const RenderSettings& settings, std::vector<std::string>& names,
                               FrameReport& report) {
  const PartInfo& part = source.part();
  std::vector<Plane> planes;
  for (const int c : channels) {
    names.push_back(part.channels[static_cast<std::size_t>(c)]);
    planes.push_back(source.file.plane(source.choice.part, c));
  }
  report.nonfinite += handle_nonfinite(planes, settings.nonfinite, part.data, source.file.path());
  return planes;
}

void choose_further_channels(const FramePaths& paths, const RenderSettings& settings,
                             Source& source) {
  if (settings.channels.empty()) return;
  source.further = choose_further(source.file, source.choice, settings.channels);
  if (!keeps_other_channels(paths.output, source.file)) {
    fail(ErrorKind::usage, "{}: {} needs a format that holds them: the input's own, {}",
         paths.output, field("channels"), std::filesystem::path(paths.input).extension().string());
  }
}

/// The lens once more for each group of light channels: with the colour's depth and CoC, but what
/// lies behind and mixed pixels are estimated from the group's own values. Puts the planes into
/// `choice` and `planes`, to be written with the colour.
void render_light(const Source& source, Frame frame, const RenderSettings& settings,
                  Backend& backend, FrameReport& report, ColourChoice& choice,
                  std::vector<Plane>& planes) {
  for (const LightGroup& group : source.further.light) {
    frame.channels = read_planes(source, group.channels, settings, report.light_channels, report);
    frame.has_alpha = group.has_alpha;
    const std::vector<Plane> out = apply_method(frame, settings.method, backend).colour;
    choice.channels.insert(choice.channels.end(), group.channels.begin(), group.channels.end());
    planes.insert(planes.end(), out.begin(), out.end());
  }
}

/// Gives data channels the values of the nearest hits.
void move_data(Source& source, const std::vector<std::uint32_t>& nearest, FrameReport& report) {
  for (const int c : source.further.data) {
    report.data_channels.push_back(source.part().channels[static_cast<std::size_t>(c)]);
    source.file.move_values(source.choice.part, c, nearest);
  }
}

Source read_source(const FramePaths& paths, const RenderSettings& settings, FrameReport& report) {
  Source source{ImageFile::read(paths.input), {}, {}, {}};
  source.choice = choose_colour(paths.input, source.file.parts(), settings.request);
  const PartInfo& part = source.part();
  report.data = part.data;
  report.display = part.display;
  choose_further_channels(paths, settings, source);
  source.colour =
      read_planes(source, source.choice.channels, settings, report.colour_channels, report);
  report.nonfinite_kept = settings.nonfinite == Nonfinite::keep;
  if (settings.method.method == Method::tiltshift) return source;
  DepthPlane depth = read_depth(source.file, source.choice, settings.request, paths.depth);
  source.depth = std::move(depth.values);
  report.depth_channel = std::move(depth.channel);
  CameraValues camera = settings.camera;
  if (settings.camera_from_metadata) {
    camera = camera_from_metadata(source.file, settings.metres_per_unit).overridden_by(camera);
    camera.source = paths.input + "'s metadata";
  }
  report.lens = make_lens(camera, settings.metres_per_unit, settings.model, settings.max_coc_px);
  report.depth = convert_depth(source.depth, settings.depth, part.data, part.display, report.lens,
                               paths.depth.empty() ? paths.input : paths.depth);
  if (!overlap(part.data, part.display)) {
    report.notes.push_back(
        fmt::format("the data window {} lies outside the display window {}: "
                    "nothing of it is seen there",
                    to_string(part.data), to_string(part.display)));
  }
  const auto aspect = source.file.metadata_number("PixelAspectRatio");
  if (aspect && std::fabs(*aspect - 1) > 1e-6) {
    report.notes.push_back(
        fmt::format("pixel aspect ratio {} is not modelled: the CoC is round in pixels", *aspect));
  }
  return source;
}

/// The outputs must be writable before the work.
void check_outputs(const FramePaths& paths, const std::string& compression) {
  check_output_format(paths.output);
  check_can_write(paths.output);
  const std::pair<const char*, const std::string&> data_files[] = {
      {"coc", paths.coc}, {"confidence", paths.confidence}, {"tiles", paths.tiles}};
  for (const auto& [name, path] : data_files) {
    if (path.empty()) continue;
    check_plane_format(path, name);
    check_can_write(path);
  }
  check_compression({paths.output, paths.coc, paths.confidence, paths.tiles}, compression);
}

RenderJob job_of(const Source& source, const RenderSettings& settings, const FrameReport& report) {
  RenderJob job;
  job.frame.channels = Planes::view(source.colour);
  job.frame.depth = Values<float>::view(source.depth.data(), source.depth.size());
  job.data = report.data;
  job.display = report.display;
  job.lens = report.lens;
  job.method = settings.method;
  job.tiltshift = settings.tiltshift;
  job.wants_nearest = !source.further.data.empty();
  return job;
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
  check_outputs(s.paths, s.settings.compression);
  Stopwatch watch;
  s.source.emplace(read_source(s.paths, s.settings, s.report));
  s.report.read_seconds = watch.lap();
}

void FileRender::render(Device& device, const Progress& progress) {
  State& s = *state_;
  if (!s.source) fail(ErrorKind::usage, "{}: read() comes before render()", s.paths.input);
  Backend& backend = backend_of(device);
  Stopwatch watch;
  Rendered rendered = defray::render(job_of(*s.source, s.settings, s.report), backend, progress);
  describe(rendered, s.settings.method, s.report);
  s.choice = s.source->choice;
  s.planes = std::move(rendered.result.colour);
  render_light(*s.source, rendered.frame, s.settings, backend, s.report, s.choice, s.planes);
  move_data(*s.source, rendered.result.nearest, s.report);
  if (!s.paths.coc.empty()) s.coc_px = radii_px(rendered.frame.coc_quanta.host());
  if (!s.paths.tiles.empty()) s.tiles = rendered.result.tiles.picture();
  s.confidence = std::move(rendered.result.confidence);
  s.report.render_seconds = watch.lap();
}

FrameResult FileRender::write() {
  State& s = *state_;
  if (s.planes.empty()) fail(ErrorKind::usage, "{}: render() comes before write()", s.paths.input);
  Stopwatch watch;
  if (!s.settings.compression.empty()) s.source->file.set_compression(s.settings.compression);
  write_picture(s.paths.output, s.source->file, s.choice, s.planes, s.report.notes);
  const auto write_data = [&](const std::string& path, const char* name, const Plane& plane) {
    if (!path.empty()) write_plane(path, name, s.source->file, s.source->choice.part, plane);
  };
  write_data(s.paths.coc, "coc", s.coc_px);
  write_data(s.paths.confidence, "confidence", s.confidence);
  write_data(s.paths.tiles, "tiles", s.tiles);
  s.report.write_seconds = watch.lap();
  s.planes.resize(s.source->choice.channels.size());  // the picture's own
  return {std::move(s.report), std::move(s.planes)};
}

FrameResult render_file(Device& device, const FramePaths& paths, const RenderSettings& settings,
                        const Progress& progress) {
  FileRender frame(paths, settings);
  frame.read();
  frame.render(device, progress);
  return frame.write();
}

}  // namespace defray
