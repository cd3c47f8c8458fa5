#pragma once
// Ray-traced scenes that lie in a folder, as `defray scene` writes them.
#include <string>
#include <vector>

#include "bench.h"

namespace defray::perf {

/// A scene at one focus, and its truth.
struct MeasuredPlace {
  std::string name;
  Subject subject;
  std::vector<Plane> truth;
};

/// What --scenes is, for its help.
inline constexpr const char* scenes_help =
    "folder of scenes, each with pinhole.exr, truth_SETTING.exr, camera.json";

/// Throws Error(input) where that is not empty, nor a folder.
void check_scenes(const std::string& scenes);

/// Every focus setting that has a truth of every scene of the bench's folder, in order of their
/// names.
std::vector<MeasuredPlace> read_places(const Bench& bench);

}  // namespace defray::perf
