#include "library/file_info.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"

namespace defray {
namespace {

constexpr double background_from = 1e9, half_background = 65504;

DepthCandidate candidate_of(const ImageFile& file, const ChannelName& channel) {
  DepthCandidate d{channel, is_mist(channel)};
  const Plane values = file.plane(channel.part, channel.channel);
  d.pixels = values.size();
  d.smallest = std::numeric_limits<double>::infinity();
  d.largest = -d.smallest;
  for (const float value : values) {
    const auto z = static_cast<double>(value);
    if (!std::isfinite(z) || std::fabs(z) >= background_from || std::fabs(z) == half_background ||
        z == 0) {
      ++d.background;
      continue;
    }
    d.negative += z < 0;
    d.smallest = std::min(d.smallest, z);
    d.largest = std::max(d.largest, z);
  }
  if (d.background == d.pixels) d.smallest = d.largest = 0;
  return d;
}

/// 'name' where a shell needs it.
std::string quoted(const std::string& text) {
  const bool is_plain = std::all_of(text.begin(), text.end(), [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) ||
           std::string("_./-").find(c) != std::string::npos;
  });
  return is_plain ? text : "'" + text + "'";
}

std::string depth_options(const FileInfo& info, const DepthCandidate& depth) {
  std::string options;
  const bool is_clear = info.depth.size() == 1 || info.depth[1].is_mist;
  if (!is_clear) options += " --depth-channel " + quoted(depth.channel.full);
  if (2 * depth.negative > depth.pixels - depth.background) options += " --depth-kind negative-z";
  return options;
}

const FoundAttribute* found_in(const FileInfo& info, const std::string& field) {
  const auto found =
      std::find_if(info.camera.begin(), info.camera.end(),
                   [&](const FoundAttribute& f) { return f.attribute.field == field; });
  return found == info.camera.end() ? nullptr : &*found;
}

/// Whether `render` takes the field from the metadata.
bool has(const FileInfo& info, const std::string& field) {
  const FoundAttribute* found = found_in(info, field);
  return found && found->value;
}

/// What the metadata does not say, or not so that it can be used, with usual values to begin with.
std::string lens_options(const FileInfo& info, const PartInfo& part) {
  const bool has_sensor =
      has(info, "sensor_width_mm") || (has(info, "fov_deg") && !found_in(info, "sensor_width_mm"));
  const std::pair<bool, std::string> values[] = {
      {has(info, "focus_distance_units"),
       fmt::format(" --focus-at {},{}", part.display.width / 2, part.display.height / 2)},
      {has(info, "fstop"), " --fstop 2.8"},
      {has(info, "focal_length_mm"), " --focal-length 50"},
      {has_sensor, " --sensor-width 36"}};
  std::string options;
  bool is_any_there = false;
  for (const auto& [is_there, option] : values) {
    is_any_there |= is_there;
    if (!is_there) options += option;
  }
  return (is_any_there ? " --camera from-metadata" : "") + options;
}

std::string command_of(const FileInfo& info) {
  if (!info.colour || info.depth.empty() || info.depth.front().is_mist) return "";
  const PartInfo& part = info.parts[static_cast<std::size_t>(info.colour->part)];
  return fmt::format("defray render {} -o out.exr{}{}", quoted(info.path),
                     depth_options(info, info.depth.front()), lens_options(info, part));
}

}  // namespace

FileInfo describe_file(const std::string& path) {
  const ImageFile file = ImageFile::read(path);
  FileInfo info{path, file.parts(), {}, {}, {}, {}, {}};
  try {
    info.colour = choose_colour(path, info.parts, {});
  } catch (const Error& error) {
    info.no_colour = error.marked();
  }
  for (const ChannelName& name :
       depth_candidates(info.parts, info.colour.value_or(ColourChoice{}))) {
    info.depth.push_back(candidate_of(file, name));
  }
  for (const CameraAttribute& attribute : camera_attributes()) {
    if (found_in(info, attribute.field)) continue;
    if (const auto found = find_attribute(file, attribute)) info.camera.push_back(*found);
  }
  info.command = command_of(info);
  return info;
}

std::vector<std::pair<std::string, std::vector<std::string>>> layers_of(const PartInfo& part) {
  std::vector<std::pair<std::string, std::vector<std::string>>> layers;
  for (const ChannelName& name : channel_names({part})) {
    const auto known = std::find_if(layers.begin(), layers.end(),
                                    [&](const auto& layer) { return layer.first == name.layer; });
    if (known != layers.end()) {
      known->second.push_back(name.base);
    } else {
      layers.push_back({name.layer, {name.base}});
    }
  }
  return layers;
}

}  // namespace defray
