#pragma once
// Colours that are no numbers.
#include <cstddef>
#include <string>
#include <vector>

#include "base/plane.h"
#include "base/window.h"
#include "defray/options.h"

namespace defray {

/// How many values are NaN or Inf; with Nonfinite::zero they are 0 afterwards. Throws Error(input)
/// for the first one, which names `path`, with Nonfinite::error.
std::size_t handle_nonfinite(std::vector<Plane>& colour, Nonfinite policy, const Window& data,
                             const std::string& path);

}  // namespace defray
