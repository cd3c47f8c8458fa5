#pragma once
// Channels beside the colour that go through the lens too.
#include <string>
#include <vector>

#include "image/channels.h"

namespace defray {

/// Channels of one layer that are averaged together.
struct LightGroup {
  std::vector<int> channels;  ///< 1 to 4, alpha last.
  bool has_alpha = false;
};

/// What RenderSettings::channels names, of the colour's part.
struct FurtherChannels {
  std::vector<LightGroup> light;  ///< Averaged as the colour is.
  std::vector<int> data;          ///< These get the value of the nearest hit.
};

/// "a,b.*" -> {a, b.*}. Throws Error(usage) when a name is empty.
std::vector<std::string> parse_channel_list(const std::string& list);

/// The channels that `patterns` (names, or globs with * and ?) mean; patterns never mean colour.
/// Throws Error(input) for a pattern that means none in the colour's part and view, and says why.
FurtherChannels choose_further(const ImageFile& file, const ColourChoice& colour,
                               const std::vector<std::string>& patterns);

}  // namespace defray
