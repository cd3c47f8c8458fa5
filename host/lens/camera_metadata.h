#pragma once
// Lens values among an image's metadata, by the names that renderers write.
#include <optional>
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

/// All names that are looked for, as they are or behind "exr/" or "vray/"; the first that is there
/// counts.
const std::vector<CameraAttribute>& camera_attributes();

/// A value of the lens among the metadata.
struct FoundAttribute {
  CameraAttribute attribute;
  std::string name;             ///< As the file spells it.
  std::string text;             ///< As stored; of a matrix, what it comes to.
  std::optional<double> value;  ///< Times the factor; empty where it is no number above 0.
  bool is_matrix = false;       ///< A projection: it says itself which side of the frame it spans.
};

/// Empty where the file has no such attribute, or it says that there is no such value.
std::optional<FoundAttribute> find_attribute(const ImageFile& file,
                                             const CameraAttribute& attribute);

/// Empty where absent, and where `stated` says the same: what is stated wins, and what it wins over
/// may be anything. `source` of the values names the file.
/// Throws Error(input), with file, attribute and value, for one that is no number or not above 0.
CameraValues camera_from_metadata(const ImageFile& file, double metres_per_unit,
                                  const CameraValues& stated = {});

}  // namespace defray
