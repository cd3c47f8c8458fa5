#pragma once
// libdefray: a pinhole picture with depth in, the picture that a real lens takes out.
#include "defray/device.h"   // IWYU pragma: export
#include "defray/error.h"    // IWYU pragma: export
#include "defray/export.h"   // IWYU pragma: export
#include "defray/frame.h"    // IWYU pragma: export
#include "defray/io.h"       // IWYU pragma: export
#include "defray/lens.h"     // IWYU pragma: export
#include "defray/options.h"  // IWYU pragma: export
#include "defray/report.h"   // IWYU pragma: export
#include "defray/splat.h"    // IWYU pragma: export

namespace defray {

/// "0.1.0": of the library that runs.
DEFRAY_API const char* version();

/// Renders `picture` through `lens`. The picture's planes are read during the call only. `progress`
/// is called on the calling thread. Throws Error(usage) for planes of the wrong size and settings
/// out of range, Error(input) for depths behind the camera (and, if asked, colours that are NaN or
/// Inf), Error(device).
DEFRAY_API RenderResult render(Device& device, const Picture& picture, const Lens& lens,
                               const Options& options = {}, const Progress& progress = {});

}  // namespace defray
