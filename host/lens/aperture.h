#pragma once
// The aperture's settings, checked.
#include "defray/lens.h"

namespace defray {

/// Throws Error(usage) on values that are not allowed, or that go not together.
void validate(const Aperture& aperture);

}  // namespace defray
