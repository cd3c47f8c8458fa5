#pragma once
// What defray splat prints about a picture.
#include <string>

#include "defray/splat.h"

namespace defray::cli {

/// One JSON line.
void print_json(const std::string& path, const Lens& lens, const CameraPose& pose,
                const SplatReport& r, double seconds);

void print_text(const std::string& path, const Lens& lens, const SplatReport& r, double seconds,
                const Device& device);

}  // namespace defray::cli
