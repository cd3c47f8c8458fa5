#pragma once
// Which cases a kernel is tried on.
#include <cstddef>
#include <vector>

#include "validation/kernel_checks.h"

namespace defray::validation {

enum class Level {
  tiny,   ///< A few pixels: for simulators that take a thousand times longer.
  quick,  ///< All kinds of input, each kernel in seconds.
  full,   ///< Every pattern and colour with every size and CoC; minutes.
};

/// Frames of awkward sizes with CoC radii from 0 to beyond every frame; over them the patterns,
/// colours, channel counts, work-groups (up to `max_work_group` work-items) and band heights vary.
/// The same list every time.
std::vector<Case> grid(Level level, const KernelCheck& check, std::size_t max_work_group);

}  // namespace defray::validation
