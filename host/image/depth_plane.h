#pragma once
// The depth that goes with a picture.
#include <string>

#include "base/plane.h"
#include "image/channels.h"
#include "image/image_file.h"

namespace defray {

struct DepthPlane {
  Plane values;          ///< As stored.
  std::string channel;   ///< Its name, for people.
  int integer_bits = 0;  ///< As PartInfo has it.
  bool is_mist = false;
  bool is_smoothed = false;  ///< Between its steps.
};

/// From the colour's own file, or from `depth_path`, if given: the part in the colour's data
/// window, all of which it must have. Throws Error(input).
DepthPlane read_depth(const ImageFile& colour_file, const ColourChoice& colour,
                      const ChannelRequest& request, const std::string& depth_path);

}  // namespace defray
