#include "library/source.h"

#include <cmath>
#include <filesystem>
#include <limits>

#include "base/error.h"
#include "image/depth_plane.h"
#include "image/nonfinite.h"
#include "image/output.h"
#include "library/grow_window.h"
#include "library/source_lens.h"

namespace defray {
namespace {

void choose_further_channels(const FramePaths& paths, const RenderSettings& settings,
                             Source& source) {
  if (settings.channels.empty()) return;
  source.further = choose_further(source.file, source.choice, settings.channels);
  if (!keeps_other_channels(paths.output, source.file)) {
    fail(ErrorKind::usage, "{}: {} needs a format that holds them: the input's own, {}",
         paths.output, field("channels"), std::filesystem::path(paths.input).extension().string());
  }
}

/// Makes room for the blur of what ends at the data window's edge.
void grow(Source& source, const RenderSettings& settings, FrameReport& report) {
  const Window from = report.data;
  const Plane* const alpha = has_alpha(source.colour) ? &source.colour.back() : nullptr;
  const auto grown = [&](std::optional<Grow> how_far) {
    return grown_window(from, source.part().display, alpha, source.depth, report.lens,
                        report.display.width, how_far);
  };
  const Window to = grown(settings.grow);
  if (to == from) {
    const bool may_end_there = alpha && !settings.grow && grown(Grow::display) != from;
    if (may_end_there) {
      report.notes.push_back(
          fmt::format("the data window {} has no transparent pixel, and counts as cut out of a "
                      "picture: it does "
                      "not grow by the blur; if what it shows ends there, {} display",
                      to_string(from), field("grow")));
    }
    return;
  }
  require_allowed_size(fmt::format("{}: its data window, grown by the blur ({} none lets it be),",
                                   source.file.path(), field("grow")),
                       to.width, to.height);
  for (Plane& plane : source.colour) plane = enlarged(plane, from, to, 0);
  source.depth = enlarged(source.depth, from, to, std::numeric_limits<float>::infinity());
  source.file.grow(source.choice.part, to);
  report.data = to;
  report.notes.push_back(
      fmt::format("the data window {} grows by the blur to {}", to_string(from), to_string(to)));
}

}  // namespace

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

Source read_source(const FramePaths& paths, const RenderSettings& settings, FrameReport& report) {
  Source source{ImageFile::read(paths.input), {}, {}, {}};
  source.choice = choose_colour(paths.input, source.file.parts(), settings.request);
  const PartInfo& part = source.part();
  report.data = part.data;
  report.display = lens_window(part, settings, paths.input);
  choose_further_channels(paths, settings, source);
  source.colour =
      read_planes(source, source.choice.channels, settings, report.colour_channels, report);
  report.nonfinite_kept = settings.nonfinite == Nonfinite::keep;
  if (!has_lens(settings.method.method)) return source;
  DepthPlane depth = read_depth(source.file, source.choice, settings.request, paths.depth);
  report.depth_channel = depth.channel;
  take_lens(source.file, part, depth, settings, paths.depth.empty() ? paths.input : paths.depth,
            report);
  source.depth = std::move(depth.values);
  grow(source, settings, report);
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

}  // namespace defray
