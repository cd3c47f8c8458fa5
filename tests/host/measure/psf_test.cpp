// The diffraction PSF against closed forms, the geometric one against the CoC.
#include <fmt/format.h>

#include <cmath>

#include "host/measure/psf_support.h"
#include "reference/reference.h"

namespace defray::test::psf_test {
namespace {

TEST(Psf, GeometricRadiusIsTheCoc) {
  for (const double focus : {0.06, 3.0, 1000.0, double(INFINITY)}) {
    for (const double depth : {0.04, 1.0, 3.0, 17.0, double(INFINITY)}) {
      const Lens lens = lens_of(focus, 4);
      const PointImage image = image_of_point(lens, depth, 1920);
      const double coc = std::fabs(reference::coc_px(lens, 1920, depth));
      EXPECT_NEAR(geometric_radius_m(image) / image.pixel_m, coc, 1e-9 * (1 + coc))
          << focus << " " << depth;
    }
  }
}

TEST(Psf, InFocusItIsTheAiryPattern) {
  for (const double focus : {0.1, 3.0, double(INFINITY)}) {
    const PointImage image = image_of(focus, focus);
    const double airy = airy_radius_m(image, green);
    const DiffractionPsf psf(image, green, 20 * airy);
    EXPECT_NEAR(psf.intensity(0), 1, 1e-12);
    for (double r = airy / 7; r < 20 * airy; r += airy / 7) {
      const double v = v_of(image, r), expected = std::pow(2 * std::cyl_bessel_j(1, v) / v, 2);
      EXPECT_NEAR(psf.intensity(r), expected, 1e-10) << v;
      const double j0 = std::cyl_bessel_j(0, v), j1 = std::cyl_bessel_j(1, v);
      EXPECT_NEAR(psf.encircled_energy(r), 1 - j0 * j0 - j1 * j1, 1e-8) << v;  // Rayleigh
    }
  }
}

TEST(Psf, FirstDarkRingIsAt122LambdaN) {
  const PointImage image = image_of(3);
  // The sensor is behind the focal plane: N = 2.8 * 3 / (3 - 0.05).
  const double expected = 1.22 * green * 2.8 * 3 / 2.95;
  const DiffractionPsf psf(image, green, 2 * expected);
  double darkest = 0.5 * expected;
  for (double r = darkest; r < 1.5 * expected; r += expected / 1000) {
    if (psf.intensity(r) < psf.intensity(darkest)) darkest = r;
  }
  EXPECT_NEAR(darkest, expected, 0.01 * expected);
  EXPECT_NEAR(airy_radius_m(image, green), darkest, 0.002 * expected);
}

TEST(Psf, OnAxisItIsSincSquared) {
  // U(0) = int_0^1 exp(2 i a t) dt with a = pi alpha R^2 / (2 lambda): (sin a / a)^2.
  for (const double depth : {2.9, 3.001, 3.5, 4.0, 20.0, double(INFINITY)}) {
    const PointImage image = image_of(depth);
    const double a = pi / 2 * fresnel_zones(image, green);
    const DiffractionPsf psf(image, green, 2 * image.pixel_m);
    EXPECT_NEAR(psf.intensity(0), std::pow(std::sin(a) / a, 2), 1e-12) << depth;
  }
}

TEST(Psf, AtTheGeometricEdgeItIsBornAndWolfs) {
  // Principles of Optics, 8.8.3: where v = u (= 4 a), I = (1 - 2 J0(u) cos u + J0(u)^2) / u^2.
  for (const double depth : {2.8, 3.3, 6.0}) {
    const PointImage image = image_of(depth);
    const double edge = geometric_radius_m(image), u = 2 * pi * fresnel_zones(image, green);
    const DiffractionPsf psf(image, green, edge);
    const double j = std::cyl_bessel_j(0, u);
    EXPECT_NEAR(v_of(image, edge), u, 1e-9 * u);
    EXPECT_NEAR(psf.intensity(edge) * u * u, 1 - 2 * j * std::cos(u) + j * j, 1e-6) << depth;
  }
}

TEST(Psf, EnergyTendsToOneAndDensityIsItsDerivative) {
  const PointImage image = image_of(3.2);
  const double far = geometric_radius_m(image) + 60 * airy_radius_m(image, green);
  const DiffractionPsf psf(image, green, far);
  EXPECT_GT(psf.encircled_energy(far), 0.99);
  EXPECT_LT(psf.encircled_energy(far), 1);
  for (const double r : {far / 20, far / 7}) {
    const double h = r * 1e-4;
    const double derivative =
        (psf.encircled_energy(r + h) - psf.encircled_energy(r - h)) / (2 * h) / (2 * pi * r);
    EXPECT_NEAR(psf.density_per_m2(r), derivative, 1e-3 * derivative);
  }
}

TEST(Psf, FarFromFocusItIsTheGeometricDisc) {
  const PointImage image = image_of(1.5);
  const double disc = geometric_radius_m(image);
  ASSERT_GT(disc, 30 * airy_radius_m(image, green));
  const DiffractionPsf psf(image, green, 1.1 * disc);
  // The fringes at its edge, sqrt(1 / (2 zones)) = 10 % of the radius wide here, ring by a few
  // per cent.
  for (const double share : {0.3, 0.5, 0.7, 0.9}) {
    EXPECT_NEAR(psf.encircled_energy(share * disc), share * share, 0.04);
  }
  EXPECT_GT(psf.encircled_energy(1.1 * disc), 0.98);
  EXPECT_LT(psf.intensity(1.1 * disc), 0.05 * psf.intensity(0.5 * disc));
}

TEST(Psf, DefocusOfEitherSignLooksTheSame) {
  PointImage near = image_of(2.7), far = near;
  far.defocus_per_m = -near.defocus_per_m;
  const DiffractionPsf a(near, green, 1e-4), b(far, green, 1e-4);
  EXPECT_NEAR(a.intensity(3e-5), b.intensity(3e-5), 1e-15);
}

TEST(Psf, RefusesWhatHasNoPsf) {
  Lens closed = lens_of(3, 2.8);
  closed.aperture_diameter_mm = 0;
  expect_error(ErrorKind::usage, {"aperture diameter is 0", "no PSF"},
               [&] { image_of_point(closed, 4, 1920); });
  expect_error(ErrorKind::usage, {"depth is 0"}, [] { image_of(0); });
  expect_error(ErrorKind::usage, {"depth is nan"}, [] { image_of(NAN); });
  expect_error(ErrorKind::usage, {"focal length"}, [] { image_of(3, 0.04); });
  expect_error(ErrorKind::usage, {"width is 0"}, [] { image_of_point(lens_of(3, 2.8), 4, 0); });
  expect_error(ErrorKind::usage, {"does not converge with 32768 nodes", "Fresnel zones"},
               [] { DiffractionPsf(image_of(0.1, 3, 0.5), green, 1e-3); });
  const std::string radii =
      fmt::format("radii up to {:.4g} Airy", 1 / airy_radius_m(image_of(3), green));
  expect_error(ErrorKind::usage, {"does not converge", radii},
               [] { DiffractionPsf(image_of(3), green, 1); });
}

}  // namespace
}  // namespace defray::test::psf_test
