// Point clouds: PLY where it begins so, else text.
#include <sstream>

#include "fuzz.h"
#include "splat/clouds/cloud_columns.h"

using namespace defray;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  fuzz::run_parser([&] {
    std::istringstream file(text);
    const bool is_ply = text.starts_with("ply");
    const PointCloud cloud =
        is_ply ? read_ply(file, size, "in.ply") : read_text_cloud(file, size, "in.xyz");
    const std::size_t points = cloud.positions.size();
    fuzz::require(points <= size);
    for (const std::size_t count :
         {cloud.normals.size(), cloud.radii.size(), cloud.colours.size(), cloud.alpha.size()}) {
      fuzz::require(count == 0 || count == points);
    }
  });
  return 0;
}
