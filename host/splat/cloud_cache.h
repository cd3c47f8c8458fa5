#pragma once
// A hierarchy in a file beside its point cloud, so that the next picture begins at once.
#include <optional>
#include <string>
#include <vector>

#include "splat/hierarchy.h"

namespace defray {

/// All that is made of a point cloud.
struct CachedCloud {
  Hierarchy tree;
  std::array<double, 3> origin{};
  bool has_normals = false, has_colours = false;  ///< Given.
  std::vector<std::string> notes;
};

/// "scan.ply" -> "scan.ply.surfels".
std::string cache_path(const std::string& cloud);

/// What the cache of a cloud's file holds. Empty where there is none, where it was made of another
/// file than there is now (size and time), by another version, or is damaged: `why` then says so,
/// if there is something to say.
std::optional<CachedCloud> read_cache(const std::string& cloud, std::string& why);

/// Written beside and renamed. Throws Error(output).
void write_cache(const std::string& cloud, const CachedCloud& cached);

}  // namespace defray
