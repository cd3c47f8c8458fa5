// What is allowed "from ... to ..." is allowed at both ends, and nothing beyond them is.
#include <cfloat>
#include <cmath>

#include "lens/aperture.h"
#include "lens/depth.h"
#include "lens/lens.h"
#include "lens/lens_grid.h"
#include "lens/lens_points.h"
#include "lens/poisson_disk.h"
#include "measure/psf_report.h"
#include "methods/gather.h"
#include "methods/method.h"
#include "methods/tiltshift.h"
#include "scenes/scene.h"
#include "splat/view.h"
#include "support.h"

namespace defray::test::limits_test {
namespace {

/// `set` to each end, and to what lies beyond it.
template <typename Settings, typename Value, typename Use>
void expect_range(Value Settings::*set, double least, double most, double step, const Use& use) {
  for (const double value : {least, most}) {
    Settings s;
    s.*set = static_cast<Value>(value);
    EXPECT_NO_THROW(use(s)) << value;
  }
  for (const double value : {least - step, most + step}) {
    Settings s;
    s.*set = static_cast<Value>(value);
    expect_error(ErrorKind::usage, {}, [&] { use(s); });
  }
}

TEST(Limits, OfSettingsAreAllowedThemselves) {
  const auto gather = [](const GatherSettings& s) { validate(s); };
  expect_range(&GatherSettings::samples, 1, 1024, 1, gather);
  expect_range(&GatherSettings::passes, 1, 8, 1, gather);
  const auto chain = [](const ChainSettings& s) {
    MethodSettings method;
    method.chain = s;
    validate(method);
  };
  expect_range(&ChainSettings::pattern_shifts, 1, 64, 1, chain);
  expect_range(&ChainSettings::hidden, 0, 2, 1, chain);
  expect_range(&ChainSettings::border, 0, 2, 1, chain);
  expect_range(&ChainSettings::rays, 0, 1, 1, chain);
  expect_range(&MethodSettings::method, 0, 3, 1, [](const MethodSettings& s) { validate(s); });
  expect_range(&RdbSettings::rays, 0, 1, 1, [](const RdbSettings& s) {
    MethodSettings method;
    method.rdb = s;
    validate(method);
  });
  expect_range(&GatherSettings::kind, 0, 1, 1, [](const GatherSettings& s) {
    MethodSettings method;
    method.gather = s;
    validate(method);
  });
  const auto splat = [](const SplatSettings& s) { validate(s); };
  expect_range(&SplatSettings::psf, 0, 1, 1, splat);
  expect_range(&SplatSettings::merge, 0, 1, 1, splat);
  expect_range(&SplatSettings::cutoff, 2, 3, 0.001, splat);
  expect_range(&DepthSettings::kind, 0, 5, 1, [](DepthSettings s) {
    const bool has_ends = s.kind == DepthKind::normalized || s.kind == DepthKind::zbuffer;
    if (has_ends) s.near_units = 1, s.far_units = 2;
    validate(s);
  });
  const auto tiltshift = [](const TiltshiftSettings& s) { validate(s); };
  expect_range(&TiltshiftSettings::band_centre, 0, 1, 0.001, tiltshift);
  expect_range(&TiltshiftSettings::band_width, 0, 1, 0.001, tiltshift);
  expect_range(&TiltshiftSettings::max_blur_px, 0, 1024, 0.001, tiltshift);
  const auto aperture = [](const Aperture& a) { validate(a); };
  expect_range(&Aperture::squeeze, 0.125, 8, 0.001, aperture);
  expect_range(&Aperture::cats_eye, 0, 1, 0.001, aperture);
  const auto with_blades = [](Aperture a) {
    a.blades = a.blades ? a.blades : 4;
    validate(a);
  };
  expect_range(&Aperture::blades, 3, 32, 1, aperture);
  expect_range(&Aperture::curvature, -1, 1, 0.001, with_blades);
}

TEST(Limits, OfTheLensAreAllowedThemselves) {
  expect_range(&Lens::model, 0, 1, 1, [](Lens l) {
    l.focus_distance_units = 1;
    validate(l);
  });
  Lens near;
  near.focus_distance_units = 1;
  const auto lens = [](const Lens& l) {
    Lens focused = l;
    if (l.focus_distance_units == 0) focused.focus_distance_units = INFINITY;
    validate(focused);
  };
  for (double Lens::*value :
       {&Lens::focal_length_mm, &Lens::sensor_width_mm, &Lens::metres_per_unit}) {
    for (const double outside : {0.0, 0.99e-30, 1.01e30, double(NAN)}) {
      Lens l;
      l.*value = outside;
      expect_error(ErrorKind::usage, {"from 1e-30 to 1e+30"}, [&] { lens(l); });
    }
    Lens l;
    l.*value = 1e30;
    EXPECT_NO_THROW(lens(l));
    l.*value = 1e-30;
    EXPECT_NO_THROW(lens(l));
  }
  Lens l = near;
  for (const double px : {0.0, 1e-9, 1e30}) {
    l.max_coc_px = px;
    EXPECT_NO_THROW(validate(l));
  }
  l.max_coc_px = -1e-9;
  expect_error(ErrorKind::usage, {"max_coc_px"}, [&] { validate(l); });
  // The focus: beyond the focal length, not at it.
  l = near;
  l.focus_distance_units = std::nextafter(0.05, 1);
  EXPECT_NO_THROW(validate(l));
  l.focus_distance_units = 0.05;
  expect_error(ErrorKind::usage, {"inside the focal length"}, [&] { validate(l); });
}

TEST(Limits, OfCountsAreAllowedThemselves) {
  EXPECT_EQ(make_lens_points({}, 4096).points.size(), 4096u);
  EXPECT_EQ(make_lens_points({}, 1).points.size(), 1u);
  EXPECT_EQ(make_lens_grid(1, false).points.size(), 1u);
  EXPECT_GT(make_lens_grid(64, false).points.size(), 3000u);
  for (const int cells : {0, 65}) {
    expect_error(ErrorKind::usage, {"1 to 64"}, [&] { make_lens_grid(cells, false); });
  }
  EXPECT_EQ(make_poisson_disk(1024, 0).points.size(), 1024u);
  EXPECT_EQ(make_poisson_disk(1, 0).points.size(), 1u);
  for (const Size size : {Size{1, 16384}, Size{16384, 1}}) {
    EXPECT_EQ(make_scene("points", size.width, size.height).width, size.width);
  }
  for (const Size size : {Size{0, 8}, Size{8, 0}, Size{16385, 8}, Size{8, 16385}}) {
    expect_error(ErrorKind::usage, {"16384"},
                 [&] { make_scene("points", size.width, size.height); });
  }
  EXPECT_NO_THROW(make_scene("drift", 8, 8, scene_info("drift").frames));
  for (const int frame : {0, scene_info("drift").frames + 1}) {
    expect_error(ErrorKind::usage, {}, [&] { make_scene("drift", 8, 8, frame); });
  }
}

TEST(Limits, OfWavelengthsAreAllowedThemselves) {
  Lens lens;
  lens.focus_distance_units = 3;
  for (const double nm : {100.0, 20000.0}) {
    EXPECT_NO_THROW(measure_psf(lens, 3, 640, {nm}));
  }
}

}  // namespace
}  // namespace defray::test::limits_test
