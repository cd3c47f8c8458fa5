#include "commands/suggested_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "options/shell_quoted.h"

namespace defray::cli {
namespace {

std::string depth_options(const FileInfo& info, const DepthCandidate& depth) {
  std::string options;
  const bool is_clear = info.depth.size() == 1 || info.depth[1].is_mist;
  if (!is_clear) options += " --depth-channel " + shell_quoted(depth.channel.full);
  if (2 * depth.negative > depth.pixels - depth.background) options += " --depth-kind negative-z";
  return options;
}

/// Whether `render` takes the field from the metadata.
bool has(const FileInfo& info, const std::string& field) {
  const FoundAttribute* found = info.found(field);
  return found && found->value;
}

/// The pixel to focus on: what there is in the frame's middle, or nearest to it.
PixelPlace place_to_focus(const FileInfo& info, const PartInfo& part) {
  if (!info.depth.empty() && !info.depth.front().is_mist && info.depth.front().place) {
    return *info.depth.front().place;
  }
  const auto nearest = [](int size, int first, int count) {
    return std::clamp(size / 2, first, first + count - 1);
  };
  return {nearest(part.display.width, part.data.x - part.display.x, part.data.width),
          nearest(part.display.height, part.data.y - part.display.y, part.data.height)};
}

/// What the metadata does not say, or not so that it can be used, with usual values to begin with.
std::string lens_options(const FileInfo& info, const PartInfo& part) {
  const PixelPlace place = place_to_focus(info, part);
  const bool is_upright = part.display.height > part.display.width;
  const bool has_sensor =
      has(info, "sensor_width_mm") || (has(info, "fov_deg") && !info.found("sensor_width_mm"));
  const std::pair<bool, std::string> values[] = {
      {has(info, "focus_distance_units"), fmt::format(" --focus-at {},{}", place.x, place.y)},
      {has(info, "fstop"), " --fstop 2.8"},
      {has(info, "focal_length_mm"), " --focal-length 50"},
      {has_sensor, is_upright ? " --sensor-width 36 --sensor-fit auto" : " --sensor-width 36"}};
  std::string options;
  bool is_any_there = false;
  for (const auto& [is_there, option] : values) {
    is_any_there |= is_there;
    if (!is_there) options += option;
  }
  return (is_any_there ? " --camera from-metadata" : "") + options;
}

}  // namespace

std::string suggested_command(const FileInfo& info) {
  if (!info.colour) return "";
  const bool has_depth = !info.depth.empty() && !info.depth.front().is_mist;
  const PartInfo& part = info.parts[static_cast<std::size_t>(info.colour->part)];
  return fmt::format("defray render {} -o out.exr{}{}", shell_quoted(info.path),
                     has_depth ? depth_options(info, info.depth.front()) : " --depth FILE",
                     lens_options(info, part));
}

}  // namespace defray::cli
