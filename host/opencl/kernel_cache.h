#pragma once
// PoCL's on-disk kernel cache.

namespace defray {

/// Makes sure that PoCL can write its kernel cache: with an unwritable one it offers no device at
/// all, and says nothing. Falls back to a private folder, removed when the program ends.
/// Must run before the first OpenCL call; later calls do nothing.
void prepare_kernel_cache();

}  // namespace defray
