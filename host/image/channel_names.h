#pragma once
// Channel names of multi-layer, multi-view and multi-part files, taken apart.
#include <string>
#include <vector>

#include "image/image_file.h"

namespace defray {

/// A channel of a file, with its name taken apart.
struct ChannelName {
  int part = 0;
  int channel = 0;
  std::string full;   ///< As stored, "ViewLayer.Depth.Z".
  std::string layer;  ///< "ViewLayer.Depth"; of multi-part files, the part where the name has none.
  std::string base;   ///< "Z".
  std::string view;   ///< "left", or empty.
};

/// Whether a channel holds data, which cannot be averaged (ids, normals, positions, depth, masks'
/// ids, coordinates, motion), and not light. By its name alone: its own layer, the last part of
/// "ViewLayer.Normal", or, without a layer, its base. Any case.
bool is_data_channel(const ChannelName& name);

/// The rules of is_data_channel, for people.
std::string data_channel_rules();

/// Whether all of `name` is as `pattern` says: * stands for anything, ? for one character.
bool matches_glob(const std::string& name, const std::string& pattern);

/// Every channel of these parts.
std::vector<ChannelName> channel_names(const std::vector<PartInfo>& parts);

/// "depth_left.Z", whatever other parts have.
std::string name_in_part(const ChannelName& name, const std::vector<PartInfo>& parts);

/// "Z", or "depth_left.Z" where other parts have a Z as well.
std::string unique_name(const ChannelName& name, const std::vector<PartInfo>& parts);

/// "Z", or "Z (part depth_left)" where the file has several parts.
std::string describe(const ChannelName& name, const std::vector<PartInfo>& parts);

}  // namespace defray
