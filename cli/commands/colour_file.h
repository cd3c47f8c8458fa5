#pragma once
// What compare and sheet share: pictures of one size.
#include <optional>
#include <string>
#include <vector>

#include "base/window.h"
#include "defray/io.h"
#include "image/image_file.h"

namespace defray::cli {

/// The colour of a file: R G B, and A where it has it.
struct ColourFile {
  std::string path;
  std::vector<Plane> planes;
  Window data, display;
  bool is_grey = false;  ///< One plane of the file, three times.
};

/// Throws Error(input) as ImageFile::read and choose_colour do.
ColourFile read_colour_file(const std::string& path, const ChannelRequest& request = {});

/// What of pictures is looked at.
struct Region {
  bool overlap_only = false;   ///< Of data windows; without, all of them, 0 where one has nothing.
  std::optional<Window> crop;  ///< From the display window's left upper corner.
};

/// "union", "overlap", "320x200+10+20" -> what they say. Throws Error(usage).
void set_region(Region& region, const std::string& windows, const std::string& crop);

/// Gives all pictures one data window. Throws Error(input) where their display windows differ, the
/// crop reaches outside, or nothing is left.
void bring_together(const std::vector<ColourFile*>& pictures, const Region& region);

/// Throws Error(input) unless the display windows are the same.
void require_same_display(const ColourFile& a, const ColourFile& b);

/// Before the work: throws Error(usage) unless `path` is a PNG or JPEG and none of the inputs,
/// Error(output) unless it can be written.
void check_sheet(const std::string& path, const std::vector<std::string>& inputs);

}  // namespace defray::cli
