#pragma once
// Which channels of a file are colour and which one is depth: by name, never by guessing.
#include <string>
#include <vector>

#include "image/image_file.h"

namespace defray {

/// What the user asked for; empty: choose, and fail where the choice is not clear.
struct ChannelRequest {
  std::string layer;
  std::string view;
  std::string depth_channel;
};

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

struct ColourChoice {
  int part = 0;
  std::string layer;
  std::string view;
  std::vector<int> channels;  ///< R G B, and A where the layer has it.
};

/// The layer with R, G and B. Among several: the asked-for layer and view; else the file's default
/// view; else the unnamed layer or one with a usual beauty name. Throws Error(input) with the
/// candidates otherwise.
ColourChoice choose_colour(const std::string& path, const std::vector<PartInfo>& parts,
                           const ChannelRequest& request);

/// The depth channel that goes with `colour`. A Z beside X and Y is a vector, not a depth.
/// Throws Error(input) when there is none, or with the candidates when there are several.
ChannelName choose_depth(const std::string& path, const std::vector<PartInfo>& parts,
                         const ChannelRequest& request, const ColourChoice& colour);

/// "Z", or "Z (part depth_left)" where the file has several parts.
std::string describe(const ChannelName& name, const std::vector<PartInfo>& parts);

}  // namespace defray
