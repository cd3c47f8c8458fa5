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

/// Every channel of these parts.
std::vector<ChannelName> channel_names(const std::vector<PartInfo>& parts);

/// "Z", or "Z (part depth_left)" where the file has several parts.
std::string describe(const ChannelName& name, const std::vector<PartInfo>& parts);

}  // namespace defray
