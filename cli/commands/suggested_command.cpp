#include "commands/suggested_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "options/shell_quoted.h"

namespace defray::cli {
namespace {

std::string colour_options(const FileInfo& info) {
  std::string options;
  if (!info.request.layer.empty()) options += " --layer " + shell_quoted(info.request.layer);
  if (!info.request.view.empty()) options += " --view " + shell_quoted(info.request.view);
  return options;
}

/// The first that has a depth somewhere; null: none.
const DepthCandidate* usable_depth(const FileInfo& info) {
  const auto found = std::find_if(info.depth.begin(), info.depth.end(),
                                  [](const auto& depth) { return !depth.is_mist && depth.place; });
  if (found != info.depth.end()) return &*found;
  return info.unnamed_depth && info.unnamed_depth->place ? &*info.unnamed_depth : nullptr;
}

std::string depth_options(const FileInfo& info) {
  const DepthCandidate* found = usable_depth(info);
  if (!found) return " --depth FILE";
  const DepthCandidate& depth = *found;
  std::string options;
  const bool is_first = !info.depth.empty() && found == &info.depth.front();
  const bool is_clear = is_first && (info.depth.size() == 1 || info.depth[1].is_mist);
  if (!is_clear)
    options += " --depth-channel " + shell_quoted(unique_name(depth.channel, info.parts));
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
  if (const DepthCandidate* depth = usable_depth(info)) return *depth->place;
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
  const std::optional<ColourChoice>& colour = info.any_colour();
  if (!colour) return "";
  const PartInfo& part = info.parts[static_cast<std::size_t>(colour->part)];
  return fmt::format("defray render {} -o out.exr{}{}{}", shell_quoted(info.path),
                     colour_options(info), depth_options(info), lens_options(info, part));
}

}  // namespace defray::cli
