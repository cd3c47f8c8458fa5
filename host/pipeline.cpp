#include "pipeline.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "base/error.h"
#include "image/further_channels.h"
#include "image/output.h"
#include "image/safe_output.h"
#include "reference/reference.h"

namespace defray {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// A frame ready for the lens.
struct Frame {
  ImageFile file;
  ColourChoice choice;
  std::vector<Plane> colour;
  Plane depth;
  FurtherChannels further = {};
  const PartInfo& part() const { return file.parts()[static_cast<std::size_t>(choice.part)]; }
};

void check_paths(const FramePaths& paths) {
  std::error_code ignored;
  for (const std::string& output : {paths.output, paths.coc, paths.confidence}) {
    if (output.empty()) continue;
    for (const std::string& input : {paths.input, paths.depth}) {
      if (!input.empty() && std::filesystem::equivalent(input, output, ignored)) {
        fail(ErrorKind::usage, "{}: is input and output at once; write to another file", output);
      }
    }
  }
  const std::pair<const char*, const std::string&> outputs[] = {
      {"output", paths.output}, {"coc", paths.coc}, {"confidence", paths.confidence}};
  for (const auto& [name, path] : outputs) {
    for (const auto& [other, other_path] : outputs) {
      if (&path == &other_path) break;
      if (!path.empty() && is_same_file(path, other_path)) {
        fail(ErrorKind::usage, "{}: {} and {} are the same file", path, field(other), field(name));
      }
    }
  }
}

std::size_t handle_nonfinite(std::vector<Plane>& colour, Nonfinite policy, const Window& data,
                             const std::string& path) {
  std::size_t count = 0;
  for (Plane& plane : colour) {
    for (std::size_t i = 0; i < plane.size(); ++i) {
      if (std::isfinite(plane[i])) continue;
      ++count;
      if (policy == Nonfinite::zero) plane[i] = 0;
      if (policy == Nonfinite::error) {
        const auto width = static_cast<std::size_t>(data.width);
        fail(
            ErrorKind::input,
            "{}: colour {} at pixel ({}, {}); {} zero replaces such values, keep lets them through",
            path, plane[i], data.x + static_cast<int>(i % width),
            data.y + static_cast<int>(i / width), field("nonfinite"));
      }
    }
  }
  return count;
}

/// Depth from the colour's own file, or from another one with the same data window.
Plane read_depth(const FramePaths& paths, const RenderSettings& settings, const Frame& frame,
                 FrameReport& report) {
  std::optional<ImageFile> other;
  if (!paths.depth.empty()) other = ImageFile::read(paths.depth, Content::data);
  const ImageFile& file = other ? *other : frame.file;
  const ChannelName name = choose_depth(file.path(), file.parts(), settings.request, frame.choice);
  report.depth_channel = describe(name, file.parts());
  const PartInfo& part = file.parts()[static_cast<std::size_t>(name.part)];
  if (part.data != report.data) {
    fail(ErrorKind::input,
         "{}: depth {} has data window {}, colour in {} has {}; both must be the same", file.path(),
         report.depth_channel, to_string(part.data), paths.input, to_string(report.data));
  }
  return file.plane(name.part, name.channel);
}

/// Planes of these channels, and what was not finite in them.
std::vector<Plane> read_planes(const Frame& frame, const std::vector<int>& channels,
                               const RenderSettings& settings, std::vector<std::string>& names,
                               FrameReport& report) {
  const PartInfo& part = frame.part();
  std::vector<Plane> planes;
  for (const int c : channels) {
    names.push_back(part.channels[static_cast<std::size_t>(c)]);
    planes.push_back(frame.file.plane(frame.choice.part, c));
  }
  report.nonfinite += handle_nonfinite(planes, settings.nonfinite, part.data, frame.file.path());
  return planes;
}

void choose_further_channels(const FramePaths& paths, const RenderSettings& settings,
                             Frame& frame) {
  if (settings.channels.empty()) return;
  frame.further = choose_further(frame.file, frame.choice, settings.channels);
  if (!keeps_other_channels(paths.output, frame.file)) {
    fail(ErrorKind::usage, "{}: {} needs a format that holds them: the input's own, {}",
         paths.output, field("channels"), std::filesystem::path(paths.input).extension().string());
  }
}

/// The lens once more for each group of light channels: with the colour's depth and CoC, but what
/// lies behind and mixed pixels are estimated from the group's own values. Puts the planes into
/// `choice` and `planes`, to be written with the colour.
void render_light(const Frame& frame, const PinholeFrame& like, const RenderSettings& settings,
                  Session* session, FrameReport& report, ColourChoice& choice,
                  std::vector<Plane>& planes) {
  MethodSettings method = settings.method;
  method.rdb.wants_nearest = false;
  for (const LightGroup& group : frame.further.light) {
    const std::vector<Plane> in =
        read_planes(frame, group.channels, settings, report.light_channels, report);
    const std::vector<Plane> out =
        apply_method({like.width, like.height, like.coc_quanta, like.depth, in, group.has_alpha,
                      like.origin_x, like.origin_y, like.display_width, like.display_height},
                     method, session);
    choice.channels.insert(choice.channels.end(), group.channels.begin(), group.channels.end());
    planes.insert(planes.end(), out.begin(), out.end());
  }
}

/// Gives data channels the values of the nearest hits.
void move_data(Frame& frame, const std::vector<std::uint32_t>& nearest, FrameReport& report) {
  for (const int c : frame.further.data) {
    report.data_channels.push_back(frame.part().channels[static_cast<std::size_t>(c)]);
    frame.file.move_values(frame.choice.part, c, nearest);
  }
}

Frame read_frame(const FramePaths& paths, const RenderSettings& settings, FrameReport& report) {
  Frame frame{ImageFile::read(paths.input), {}, {}, {}};
  frame.choice = choose_colour(paths.input, frame.file.parts(), settings.request);
  const PartInfo& part = frame.part();
  report.data = part.data;
  report.display = part.display;
  choose_further_channels(paths, settings, frame);
  frame.colour =
      read_planes(frame, frame.choice.channels, settings, report.colour_channels, report);
  report.nonfinite_kept = settings.nonfinite == Nonfinite::keep;
  if (settings.method.method == Method::tiltshift) return frame;
  frame.depth = read_depth(paths, settings, frame, report);
  CameraValues camera = settings.camera;
  if (settings.camera_from_metadata) {
    camera = camera_from_metadata(frame.file, settings.metres_per_unit).overridden_by(camera);
    camera.source = paths.input + "'s metadata";
  }
  report.lens = make_lens(camera, settings.metres_per_unit, settings.model, settings.max_coc_px);
  if (settings.depth.kind == DepthKind::distance && report.lens.pixels_per_metre > 0) {
    fail(ErrorKind::usage,
         "{} distance needs the picture's field of view, which {} and {} do not state: convert the "
         "depth to planar z first",
         field("depth.kind"), field("eye"), field("pixels_per_metre"));
  }
  report.depth = convert_depth(frame.depth, settings.depth, part.data, part.display,
                               pixel_focal_length(report.lens, part.display.width),
                               paths.depth.empty() ? paths.input : paths.depth);
  if (!overlap(part.data, part.display)) {
    report.notes.push_back(
        fmt::format("the data window {} lies outside the display window {}: "
                    "nothing of it is seen there",
                    to_string(part.data), to_string(part.display)));
  }
  const auto aspect = frame.file.metadata_number("PixelAspectRatio");
  if (aspect && std::fabs(*aspect - 1) > 1e-6) {
    report.notes.push_back(
        fmt::format("pixel aspect ratio {} is not modelled: the CoC is round in pixels", *aspect));
  }
  return frame;
}

void describe_coc(const std::vector<std::int32_t>& coc, FrameReport& report) {
  const auto [smallest, largest] = std::minmax_element(coc.begin(), coc.end());
  constexpr double quantum = 1.0 / (1 << DEFRAY_COC_FRACTION_BITS);
  report.nearest_coc_px = *smallest * quantum;
  report.farthest_coc_px = *largest * quantum;
  const auto limit =
      static_cast<std::int32_t>(coc_params(report.lens, report.display.width, 0).limit_quanta);
  report.coc_limited = static_cast<std::size_t>(
      std::count_if(coc.begin(), coc.end(), [&](auto q) { return std::abs(q) == limit; }));
}

std::vector<std::int32_t> find_coc(const Frame& frame, const RenderSettings& settings,
                                   Session* session, FrameReport& report) {
  const Window &data = report.data, &display = report.display;
  if (settings.method.method == Method::tiltshift) {
    const DefrayTiltshiftParams p = tiltshift_params(settings.tiltshift, data.width, data.height,
                                                     data.y - display.y, display.height);
    return session ? tiltshift_on_device(*session, p) : reference::tiltshift(p);
  }
  return session ? coc_on_device(*session, report.lens, display.width, frame.depth)
                 : reference::coc(report.lens, display.width, frame.depth);
}

}  // namespace

FrameResult render_frame(const FramePaths& paths, const RenderSettings& settings, Session* session,
                         const std::function<void(double)>& progress) {
  FrameReport report;
  report.paths = paths;
  report.method = settings.method.method;
  check_paths(paths);
  check_can_write(paths.output);
  const std::pair<const char*, const std::string&> data_files[] = {
      {"coc", paths.coc}, {"confidence", paths.confidence}};
  for (const auto& [name, path] : data_files) {
    if (path.empty()) continue;
    check_plane_format(path, name);
    check_can_write(path);
  }

  auto start = Clock::now();
  Frame frame = read_frame(paths, settings, report);
  report.read_seconds = seconds_since(start);

  start = Clock::now();
  const std::vector<std::int32_t> coc = find_coc(frame, settings, session, report);
  describe_coc(coc, report);
  const Window &data = report.data, &display = report.display;
  DefocusResult details;
  MethodSettings method = settings.method;
  method.rdb.wants_nearest = !frame.further.data.empty();
  const PinholeFrame pinhole{data.width,         data.height,        coc,
                             frame.depth,        frame.colour,       frame.colour.size() == 4,
                             data.x - display.x, data.y - display.y, display.width,
                             display.height};
  std::vector<Plane> result = apply_method(pinhole, method, session, progress, &details);
  ColourChoice choice = frame.choice;
  std::vector<Plane> written = result;
  render_light(frame, pinhole, settings, session, report, choice, written);
  move_data(frame, details.nearest, report);
  if (settings.method.defocus) report.defocus = details.report;
  report.render_seconds = seconds_since(start);

  start = Clock::now();
  write_picture(paths.output, frame.file, choice, written, report.notes);
  if (!paths.coc.empty()) {
    Plane radii;
    for (const std::int32_t q : coc) radii.push_back(static_cast<float>(q) * px_per_quantum);
    write_plane(paths.coc, "coc", frame.file, frame.choice.part, radii);
  }
  if (!paths.confidence.empty()) {
    write_plane(paths.confidence, "confidence", frame.file, frame.choice.part, details.confidence);
  }
  report.write_seconds = seconds_since(start);
  return {std::move(report), std::move(result)};
}

}  // namespace defray
