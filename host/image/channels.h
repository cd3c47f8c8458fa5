#pragma once
// Which channels of a file are colour and which one is depth: by name, never by guessing.
#include <optional>
#include <string>
#include <vector>

#include "defray/io.h"
#include "image/channel_names.h"
#include "image/image_file.h"

namespace defray {

struct ColourChoice {
  int part = 0;
  std::string layer;
  std::string view;
  std::vector<int> channels;  ///< R G B, or Y of a grey file; and A where the layer has it.
};

/// Every layer with R, G and B; in a file without any, every one with a Y.
std::vector<ColourChoice> all_colours(const std::vector<PartInfo>& parts);

/// The layer with R, G and B. Among several: the asked-for layer and view; else the file's default
/// view; else the unnamed layer or one with a usual beauty name. In a file without R, G and B, the
/// same among its layers with a Y. Throws Error(input) with the candidates otherwise.
ColourChoice choose_colour(const std::string& path, const std::vector<PartInfo>& parts,
                           const ChannelRequest& request);

/// A pass that fades with the distance and is clamped: no depth, whatever its channel is called.
bool is_mist(const ChannelName& name);

/// All that could be the depth of `colour`, the surest first.
std::vector<ChannelName> depth_candidates(const std::vector<PartInfo>& parts,
                                          const ColourChoice& colour);

/// The only channel that `colour` has not; none where there are several.
std::optional<ChannelName> only_other_channel(const std::vector<PartInfo>& parts,
                                              const ColourChoice& colour);

/// The depth channel that goes with `colour`. A Z beside X and Y is a vector, not a depth.
/// The only channel of a file is its depth, whatever its name; but none that is `colour` is, which
/// has no channels where it is another file's.
/// Throws Error(input) when there is none, or with the candidates when there are several.
ChannelName choose_depth(const std::string& path, const std::vector<PartInfo>& parts,
                         const ChannelRequest& request, const ColourChoice& colour);

}  // namespace defray
