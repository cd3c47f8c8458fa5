#pragma once
// Kernel, twin and their difference as pictures.
#include <cstddef>
#include <optional>

#include "validation/validation.h"

namespace defray::validation {

/// The plane that holds value `at` of this run, each panel stretched to be seen; nothing where the
/// values are no picture (tiles).
std::optional<WorstPicture> worst_picture(const Case& c, const Run& run, std::size_t at);

}  // namespace defray::validation
