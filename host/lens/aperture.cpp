#include "lens/aperture.h"

#include <cmath>

#include "base/error.h"

namespace defray {
namespace {

void check_range(const char* option, double value, double least, double most) {
  if (value >= least && value <= most) return;  // not so for NaN
  fail(ErrorKind::usage, "{} is {}: allowed are {} to {}", option, value, least, most);
}

}  // namespace

void validate(const Aperture& a) {
  if (a.blades != 0 && (a.blades < 3 || a.blades > 32)) {
    fail(ErrorKind::usage, "--blades is {}: allowed are 0 (a circle) and 3 to 32", a.blades);
  }
  check_range("--blade-curvature", a.curvature, -1, 1);
  if (!std::isfinite(a.rotation_deg)) {
    fail(ErrorKind::usage, "--blade-rotation is {} degrees: it must be finite", a.rotation_deg);
  }
  check_range("--squeeze", a.squeeze, 0.125, 8);
  check_range("--cats-eye", a.cats_eye, 0, 1);
  if (a.blades == 3 && a.curvature < 0) {
    fail(ErrorKind::usage, "--blade-curvature is {} with 3 blades: below 0 it goes with 4 or more",
         a.curvature);
  }
  if (!a.image.empty() && a.blades != 0) {
    fail(ErrorKind::usage, "--aperture-image and --blades: choose one shape");
  }
  if (a.blades == 0 && (a.curvature != 0 || a.rotation_deg != 0)) {
    fail(ErrorKind::usage, "--blade-curvature and --blade-rotation go with --blades");
  }
}

}  // namespace defray
