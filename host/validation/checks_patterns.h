#pragma once
#include <vector>

#include "validation/kernel_checks.h"

namespace defray::validation {

/// Entries of the kernels of `patterns`.
std::vector<KernelCheck> pattern_checks();

}  // namespace defray::validation
