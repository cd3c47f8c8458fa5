#pragma once
// What defray tune renders: pictures of one class each.
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "defray/defray.h"

namespace defray::cli {

using Drawn = std::vector<std::vector<float>>;

struct Workload {
  std::string about;        ///< "rdb, spheres, 1920x1080, CoC up to 40 px".
  std::string frame_class;  ///< As tuning::frame_class has it.
  std::function<Drawn(Device&)> draw;
  std::function<Drawn(Device&)> draw_small;  ///< By the same kernels, small enough for the twins.
};

/// Of a class of sizes ("small", "hd", "uhd") and a method ("rdb", "gather", "linear"): a built-in
/// scene with lamps and narrow circles, and one of wide ones with much that is hidden; of "splat":
/// the built-in figure.
std::vector<Workload> built_in_workloads(const std::string& method, const std::string& size);

/// The user's own picture by a method. Renders it once, for the class that it is of.
Workload own_workload(Device& device, std::shared_ptr<const PictureFile> file,
                      const std::string& name, const Lens& lens, const Options& options);

/// "rdb" with all its stages, "gather", "linear". Throws Error(usage).
Options options_of(const std::string& method);

}  // namespace defray::cli
