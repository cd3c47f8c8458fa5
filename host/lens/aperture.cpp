#include "lens/aperture.h"

#include <cmath>

#include "base/error.h"

namespace defray {
namespace {

void check_range(const char* name, double value, double least, double most) {
  if (value >= least && value <= most) return;  // not so for NaN
  fail(ErrorKind::usage, "{} is {}: allowed are {} to {}", field(name), value, least, most);
}

}  // namespace

void validate(const Aperture& a) {
  if (a.blades != 0 && (a.blades < 3 || a.blades > 32)) {
    fail(ErrorKind::usage, "{} is {}: allowed are 0 (a circle) and 3 to 32", field("blades"),
         a.blades);
  }
  check_range("curvature", a.curvature, -1, 1);
  if (!std::isfinite(a.rotation_deg)) {
    fail(ErrorKind::usage, "{} is {} degrees: it must be finite", field("rotation_deg"),
         a.rotation_deg);
  }
  check_range("squeeze", a.squeeze, 0.125, 8);
  check_range("cats_eye", a.cats_eye, 0, 1);
  if (a.blades == 3 && a.curvature < 0) {
    fail(ErrorKind::usage, "{} is {} with 3 blades: below 0 it goes with 4 or more",
         field("curvature"), a.curvature);
  }
  if (!a.image.empty() && a.blades != 0) {
    fail(ErrorKind::usage, "{} and {}: choose one shape", field("aperture.image"), field("blades"));
  }
  if (a.blades == 0 && (a.curvature != 0 || a.rotation_deg != 0)) {
    fail(ErrorKind::usage, "{} and {} go with {}", field("curvature"), field("rotation_deg"),
         field("blades"));
  }
}

}  // namespace defray
