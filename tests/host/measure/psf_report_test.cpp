// What is reported of a PSF: curves over the radius, their energy, whether diffraction matters.
#include "measure/psf_report.h"

#include <cmath>
#include <fstream>

#include "host/measure/psf_support.h"

namespace defray::test::psf_report_test {
namespace {

PsfReport report_of(double depth, std::vector<double> wavelengths_nm, double fstop = 2.8,
                    int width = 1920) {
  return measure_psf(lens_of(3, fstop), depth, width, wavelengths_nm);
}

/// The mean of a radial density over the disc that the radii span.
double energy_of(const std::vector<double>& radii, const std::vector<double>& density) {
  double energy = 0;
  for (std::size_t i = 1; i < radii.size(); ++i) {
    const double here = radii[i] * density[i], before = radii[i - 1] * density[i - 1];
    energy += pi * (here + before) * (radii[i] - radii[i - 1]);
  }
  return energy;
}

TEST(PsfReport, EveryCurveHoldsTheWholeEnergy) {
  const PsfReport report = report_of(4, {450, 550, 650});
  ASSERT_EQ(report.monochrome.size(), 3u);
  for (const PsfCurve& curve : report.monochrome) {
    EXPECT_NEAR(energy_of(report.radii_px, curve.density_per_px2), 1, 0.05) << curve.wavelength_nm;
  }
  EXPECT_NEAR(energy_of(report.radii_px, report.broadband_per_px2), 1, 0.05);
  EXPECT_NEAR(energy_of(report.radii_px, report.geometric_per_px2), 1, 0.02);
}

/// How much a curve goes up and down inside the disc, its edge left out.
double ripple(const PsfReport& report, const std::vector<double>& density) {
  double sum = 0;
  for (std::size_t i = 1; report.radii_px[i] < 0.4 * report.coc_diameter_px; ++i) {
    sum += std::fabs(density[i] - density[i - 1]);
  }
  return sum;
}

TEST(PsfReport, BroadbandLightWashesTheFringesOut) {
  // Shinya's reason for the geometric model.
  const PsfReport report = report_of(5, {400, 550, 700});
  for (const PsfCurve& curve : report.monochrome) {
    EXPECT_LT(ripple(report, report.broadband_per_px2),
              0.7 * ripple(report, curve.density_per_px2));
  }
}

TEST(PsfReport, RadiiSpanTheDiscAndItsRingsFourOrMoreARing) {
  for (const double depth : {3.0, 3.02, 3.2, 4.0}) {
    for (const double fstop : {2.8, 11.0, 22.0}) {
      const PsfReport report = report_of(depth, {450, 650}, fstop);
      const PointImage image = image_of(depth, 3, fstop);
      const std::vector<double>& r = report.radii_px;
      const double disc = geometric_radius_m(image) / image.pixel_m;
      const double ring = airy_radius_m(image, 450e-9) / image.pixel_m;
      EXPECT_EQ(r.front(), 0);
      EXPECT_GE(r.back(), disc + 4 * ring) << depth << " " << fstop;
      EXPECT_GE(r.back(), 0.5);
      EXPECT_LE(r.back(), std::max(1.5 * disc + 10 * ring, 1.0));
      EXPECT_GE(r.size(), 200u);
      EXPECT_LE(r.size(), 500u);
      for (std::size_t i = 1; i < r.size(); ++i) {
        EXPECT_NEAR(r[i], r.back() * i / (r.size() - 1), 1e-9 * r.back());
      }
      EXPECT_TRUE(r[1] <= ring / 4 || r.size() == 500);
    }
  }
}

TEST(PsfReport, BroadbandIsTheMeanOverTheBand) {
  for (const double depth : {3.05, 3.6}) {
    const PsfReport report = report_of(depth, {450, 600}, 8);
    const PointImage image = image_of(depth, 3, 8);
    for (const std::size_t i : {0u, 20u, 100u}) {
      const double r = report.radii_px[i] * image.pixel_m;
      double mean = 0;
      for (int k = 0; k < 200; ++k) {
        const double wavelength = (450 + 150 * (k + 0.5) / 200) * 1e-9;
        mean += DiffractionPsf(image, wavelength, r).density_per_m2(r) / 200;
      }
      const double density = mean * image.pixel_m * image.pixel_m;
      EXPECT_NEAR(report.broadband_per_px2[i], density, 2e-3 * report.broadband_per_px2[0])
          << depth << " " << i;
    }
  }
}

TEST(PsfReport, TheTableHasARowARadius) {
  const PsfReport report = report_of(4, {450, 650});
  const Folder folder;
  write_psf_csv(folder / "psf.csv", report);
  std::ifstream table(folder / "psf.csv");
  std::string line;
  std::getline(table, line);
  for (std::size_t i = 0; i < report.radii_px.size(); ++i) {
    std::array<double, 6> row{};
    for (std::size_t c = 0; c < row.size(); ++c) {
      ASSERT_TRUE(std::getline(table, line, c + 1 < row.size() ? ',' : '\n'));
      row[c] = std::stod(line);
    }
    const std::array<double, 6> expected{report.radii_px[i],
                                         report.radii_px[i] * report.pixel_um,
                                         report.geometric_per_px2[i],
                                         report.broadband_per_px2[i],
                                         report.monochrome[0].density_per_px2[i],
                                         report.monochrome[1].density_per_px2[i]};
    for (std::size_t c = 0; c < row.size(); ++c) {
      EXPECT_NEAR(row[c], expected[c], 1e-7 * expected[c]) << i << " " << c;
    }
  }
  EXPECT_FALSE(std::getline(table, line));
}

TEST(PsfReport, OneWavelengthIsItsOwnBand) {
  const PsfReport report = report_of(4, {550});
  EXPECT_EQ(report.broadband_per_px2, report.monochrome[0].density_per_px2);
}

TEST(PsfReport, SaysWhenDiffractionMatters) {
  EXPECT_FALSE(report_of(4, {550}).diffraction_matters);
  EXPECT_FALSE(report_of(3, {550}).diffraction_matters);  // Airy disc well inside a pixel
  const PsfReport stopped_down = report_of(3, {550}, 22);
  EXPECT_TRUE(stopped_down.diffraction_matters);
  // 2.44 lambda N (1 + f / (z0 - f)) against pixels of 18.75 um.
  EXPECT_NEAR(stopped_down.monochrome[0].airy_diameter_um, 2.44 * 0.55 * 22 * 3 / 2.95, 0.02);
  EXPECT_NEAR(stopped_down.monochrome[0].airy_diameter_px,
              stopped_down.monochrome[0].airy_diameter_um / 18.75, 1e-9);
  EXPECT_FALSE(report_of(0.6, {550}, 22).diffraction_matters);  // the CoC is far larger
  EXPECT_TRUE(report_of(3, {10000}).diffraction_matters);       // thermal infrared
  EXPECT_TRUE(report_of(3, {550}, 2.8, 20000).diffraction_matters);
}

TEST(PsfReport, EnergyOutsideIsRayleighsInFocus) {
  const PsfReport report = report_of(3, {550}, 16);
  const double v = v_of(image_of(3, 3, 16), 36e-3 / 1920);
  const double j0 = std::cyl_bessel_j(0, v), j1 = std::cyl_bessel_j(1, v);
  EXPECT_NEAR(report.monochrome[0].energy_outside, j0 * j0 + j1 * j1, 1e-8);
  EXPECT_EQ(report.coc_diameter_px, 0);
}

TEST(PsfReport, ChartMarksThePixelAndLeavesOutAGeometricPoint) {
  const auto names = [](const Plot& plot) {
    std::vector<std::string> all;
    for (const Series& series : plot.series) all.push_back(series.name);
    return all;
  };
  using Names = std::vector<std::string>;
  EXPECT_EQ(names(psf_plot(report_of(4, {450, 650}), false)),
            (Names{"geometric", "450 nm", "650 nm", "450 to 650 nm", "half a pixel"}));
  EXPECT_EQ(names(psf_plot(report_of(3, {550}), false)), (Names{"550 nm", "half a pixel"}));
  const Plot plot = psf_plot(report_of(4, {550}), true);
  EXPECT_TRUE(plot.y_log);
  EXPECT_EQ(plot.series.back().points.back().x, 0.5);
  double largest = 0, least = HUGE_VAL;
  for (const Series& series : plot.series) {
    for (const PlotPoint& point : series.points) {
      if (series.name == "550 nm") largest = std::max(largest, point.y);
      least = std::min(least, point.y);
    }
  }
  EXPECT_NEAR(least / largest, 1e-6, 1e-9);
}

TEST(PsfReport, RefusesImpossibleWavelengths) {
  expect_error(ErrorKind::usage, {"wavelength is 99 nm", "100 to 20000"}, [] {
    report_of(4, {550, 99});
  });
  expect_error(ErrorKind::usage, {"wavelength is 20001 nm"}, [] { report_of(4, {20001}); });
  expect_error(ErrorKind::usage, {"wavelength is nan"}, [] { report_of(4, {NAN}); });
  expect_error(ErrorKind::usage, {"no wavelength"}, [] { report_of(4, {}); });
}

}  // namespace
}  // namespace defray::test::psf_report_test
