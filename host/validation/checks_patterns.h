#pragma once
#include <vector>

#include "validation/kernel_checks.h"

namespace defray::validation {

/// Entries of the kernels of `patterns`.
std::vector<KernelCheck> patterns_checks();

}  // namespace defray::validation
