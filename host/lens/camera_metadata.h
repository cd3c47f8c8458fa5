#pragma once
// Lens values among an image's metadata, by the names that renderers write.
#include <string>
#include <vector>

#include "image/image_file.h"
#include "lens/lens.h"

namespace defray {

/// What an attribute means.
struct CameraAttribute {
  const char* field;  ///< Of CameraValues.
  const char* name;
  double factor;        ///< To the field's unit; 0: metres, to scene units.
  const char* written;  ///< By whom.
};

/// All names that are looked for, the first that is there counts.
const std::vector<CameraAttribute>& camera_attributes();

/// Empty where absent. `source` of the values names the file.
/// Throws Error(input), with file, attribute and value, for one that is no number or not above 0.
CameraValues camera_from_metadata(const ImageFile& file, double metres_per_unit);

}  // namespace defray
