#include "aperture_options.h"

#include "options.h"

namespace defray::cli {

void add_aperture_options(CLI::App& c, ApertureOptions& o) {
  const char* const group = "Aperture";
  c.add_option("--blades", o.blades, "Corners of the iris, 3 to 32; default 0: a circle")
      ->group(group);
  c.add_option("--blade-curvature", o.curvature,
               "0 (default): straight; 1: a circle; below 0, to -1: hollow, from 4 blades on")
      ->group(group);
  c.add_option("--blade-rotation", o.rotation_deg,
               "Degrees counter-clockwise, seen behind the focus; default 0: a side on the right")
      ->group(group);
  c.add_option("--squeeze", o.squeeze,
               "Height of highlights over their width, 0.125 to 8; default 1; 2x anamorphic: 2")
      ->group(group);
  c.add_option("--aperture-image", o.image,
               "A picture of the bokeh, as it shows behind the focus; black lets no light through")
      ->group(group);
  c.add_option("--cats-eye", o.cats_eye,
               "Vignetting: offset of the lens rim at the corners, aperture radii, 0 to 1; default "
               "0; 1 leaves 39 % of a corner's light")
      ->group(group);
}

Aperture to_aperture(const ApertureOptions& o) {
  const Aperture defaults;
  const Aperture a{o.blades.value_or(defaults.blades),
                   o.curvature.value_or(defaults.curvature),
                   o.rotation_deg.value_or(defaults.rotation_deg),
                   o.squeeze.value_or(defaults.squeeze),
                   o.image,
                   o.cats_eye.value_or(defaults.cats_eye)};
  validate(a);
  return a;
}

}  // namespace defray::cli
