#include "library/file_info.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "lens/depth.h"

namespace defray {
namespace {

DepthCandidate candidate_of(const ImageFile& file, const ChannelName& channel) {
  DepthCandidate d{channel, is_mist(channel)};
  const Plane values = file.plane(channel.part, channel.channel);
  const PartInfo& part = file.parts()[static_cast<std::size_t>(channel.part)];
  std::int64_t nearest = std::numeric_limits<std::int64_t>::max();
  d.pixels = values.size();
  d.smallest = std::numeric_limits<double>::infinity();
  d.largest = -d.smallest;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto z = static_cast<double>(values[i]);
    if (!std::isfinite(z) || std::fabs(z) >= far_away || std::fabs(z) == largest_half || z == 0) {
      ++d.background;
      continue;
    }
    d.negative += z < 0;
    d.smallest = std::min(d.smallest, z);
    d.largest = std::max(d.largest, z);
    const auto width = static_cast<std::size_t>(part.data.width);
    const PixelPlace place{part.data.x - part.display.x + static_cast<int>(i % width),
                           part.data.y - part.display.y + static_cast<int>(i / width)};
    const std::int64_t x = place.x - part.display.width / 2, y = place.y - part.display.height / 2;
    if (x * x + y * y >= nearest) continue;
    nearest = x * x + y * y;
    d.place = place;
  }
  if (d.background == d.pixels) d.smallest = d.largest = 0;
  return d;
}

/// By a layer or view, one of several colours among which none is the first.
void choose_by_name(FileInfo& info) {
  for (const ColourChoice& choice : all_colours(info.parts)) {
    const ChannelRequest request{choice.layer, choice.view, ""};
    try {
      info.colour_by_name = choose_colour(info.path, info.parts, request);
      info.request = request;
      return;
    } catch (const Error&) {  // its names are others', too
    }
  }
}

}  // namespace

const FoundAttribute* FileInfo::found(const std::string& field) const {
  const auto same = std::find_if(camera.begin(), camera.end(), [&](const FoundAttribute& f) {
    return f.attribute.field == field;
  });
  return same == camera.end() ? nullptr : &*same;
}

const std::optional<ColourChoice>& FileInfo::any_colour() const {
  return colour ? colour : colour_by_name;
}

FileInfo describe_file(const std::string& path) {
  const ImageFile file = ImageFile::read(path);
  FileInfo info;
  info.path = path;
  info.parts = file.parts();
  try {
    info.colour = choose_colour(path, info.parts, {});
  } catch (const Error& error) {
    info.no_colour = error.marked();
    choose_by_name(info);
  }
  const ColourChoice colour = info.any_colour().value_or(ColourChoice{});
  for (const ChannelName& name : depth_candidates(info.parts, colour)) {
    info.depth.push_back(candidate_of(file, name));
  }
  const auto other = only_other_channel(info.parts, colour);
  if (info.depth.empty() && other) info.unnamed_depth = candidate_of(file, *other);
  for (const CameraAttribute& attribute : camera_attributes()) {
    if (info.found(attribute.field)) continue;
    if (const auto found = find_attribute(file, attribute)) info.camera.push_back(*found);
  }
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
