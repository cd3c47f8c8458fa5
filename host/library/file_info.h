#pragma once
// What a file offers to `defray render`.
#include <optional>
#include <string>
#include <vector>

#include "defray/io.h"
#include "image/channels.h"
#include "lens/camera_metadata.h"

namespace defray {

/// A channel that could be depth, and what is stored in it.
struct DepthCandidate {
  ChannelName channel;
  bool is_mist = false;
  double smallest = 0, largest = 0;  ///< Of the numbers that are not background.
  std::size_t background = 0, negative = 0, pixels = 0;
  /// Of the pixels that are not background, the one nearest to the display window's middle, in
  /// that window; none: all are.
  std::optional<PixelPlace> place = {};
};

struct FileInfo {
  std::string path;
  std::vector<PartInfo> parts;
  std::optional<ColourChoice> colour;
  std::string no_colour;  ///< Why there is none.
  /// The colour that `request`, a layer or view, chooses; none where names tell no two apart.
  std::optional<ColourChoice> colour_by_name;
  ChannelRequest request;
  std::vector<DepthCandidate> depth;
  /// Without depth by name: the only channel that is no colour.
  std::optional<DepthCandidate> unnamed_depth;
  std::vector<FoundAttribute> camera;  ///< The first of each field, usable or not.

  /// `colour`, or `colour_by_name`.
  const std::optional<ColourChoice>& any_colour() const;

  /// What `camera` has of this field; null: nothing.
  const FoundAttribute* found(const std::string& field) const;
};

/// Throws Error(input) where the file cannot be read.
FileInfo describe_file(const std::string& path);

/// Channel names of a part by layer: {"ViewLayer.Combined", "A B G R"}.
std::vector<std::pair<std::string, std::vector<std::string>>> layers_of(const PartInfo& part);

}  // namespace defray
