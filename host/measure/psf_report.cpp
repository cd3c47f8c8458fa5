#include "measure/psf_report.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "base/parallel.h"
#include "image/safe_output.h"
#include "measure/psf.h"

namespace defray {
namespace {

constexpr double metres_per_nm = 1e-9;
constexpr double largest_share_outside = 0.1;
constexpr double chart_floor = 1e-6;

void validate(const std::vector<double>& wavelengths_nm) {
  if (wavelengths_nm.empty()) fail(ErrorKind::usage, "no wavelength is given");
  for (const double nm : wavelengths_nm) {
    if (!(nm >= 100 && nm <= 20000)) {
      fail(ErrorKind::usage, "{} is {} nm: 100 to 20000 nm are possible", field("wavelength"), nm);
    }
  }
}

/// Wavelengths that fill the band: at its middle parts, more of them where the phase differs more.
std::vector<double> band_samples(const PointImage& image, double shortest_m, double longest_m) {
  if (shortest_m == longest_m) return {shortest_m};
  const double fringes =  // that pass the axis from one end of the band to the other
      (fresnel_zones(image, shortest_m) - fresnel_zones(image, longest_m)) / 2;
  const int count = 16 + static_cast<int>(2 * fringes);
  std::vector<double> samples;
  for (int i = 0; i < count; ++i) {
    samples.push_back(shortest_m + (longest_m - shortest_m) * (i + 0.5) / count);
  }
  return samples;
}

/// Radii over the disc and the rings around it, half a pixel at the least, four or more a ring.
std::vector<double> sample_radii_px(const PointImage& image, double shortest_m, double longest_m) {
  const double largest_m = std::max(
      1.3 * geometric_radius_m(image) + 5 * airy_radius_m(image, longest_m), 0.75 * image.pixel_m);
  const double rings = largest_m / airy_radius_m(image, shortest_m);
  const int count = std::clamp(static_cast<int>(8 * std::min(rings, 1000.0)), 200, 500);
  std::vector<double> radii;
  for (int i = 0; i < count; ++i) radii.push_back(largest_m / image.pixel_m * i / (count - 1));
  return radii;
}

/// Each radius for itself, so that threads change nothing but the time.
std::vector<double> sample(const DiffractionPsf& psf, const PsfReport& report, double pixel_m) {
  std::vector<double> density(report.radii_px.size());
  parallel_for(static_cast<int>(density.size()), [&](int i) {
    const auto at = static_cast<std::size_t>(i);
    density[at] = psf.density_per_m2(report.radii_px[at] * pixel_m) * pixel_m * pixel_m;
  });
  return density;
}

PsfCurve measure_curve(const PointImage& image, double wavelength_nm, const PsfReport& report) {
  const double wavelength_m = wavelength_nm * metres_per_nm;
  const double widened_m = geometric_radius_m(image) + image.pixel_m;
  const DiffractionPsf psf(image, wavelength_m,
                           std::max(widened_m, report.radii_px.back() * image.pixel_m));
  PsfCurve curve;
  curve.wavelength_nm = wavelength_nm;
  curve.airy_diameter_um = 2e6 * airy_radius_m(image, wavelength_m);
  curve.airy_diameter_px = 2 * airy_radius_m(image, wavelength_m) / image.pixel_m;
  curve.energy_outside = 1 - psf.encircled_energy(widened_m);
  curve.density_per_px2 = sample(psf, report, image.pixel_m);
  return curve;
}

std::vector<double> measure_broadband(const PointImage& image, const std::vector<double>& band_m,
                                      const PsfReport& report,
                                      const std::function<void(double)>& progress) {
  std::vector<double> mean(report.radii_px.size());
  for (std::size_t k = 0; k < band_m.size(); ++k) {
    const DiffractionPsf psf(image, band_m[k], report.radii_px.back() * image.pixel_m);
    const std::vector<double> density = sample(psf, report, image.pixel_m);
    for (std::size_t i = 0; i < mean.size(); ++i) {
      mean[i] += density[i] / static_cast<double>(band_m.size());
    }
    if (progress) progress(static_cast<double>(k + 1) / static_cast<double>(band_m.size()));
  }
  return mean;
}

std::vector<double> geometric_density(const PsfReport& report) {
  const double radius = report.coc_diameter_px / 2;
  std::vector<double> density;
  for (const double r : report.radii_px) {
    const bool is_inside = radius > 0 && r <= radius;
    density.push_back(is_inside ? 1 / (std::numbers::pi * radius * radius) : 0);
  }
  return density;
}

bool does_diffraction_matter(const PsfReport& report) {
  const double other = std::max(1.0, report.coc_diameter_px);
  return std::any_of(
      report.monochrome.begin(), report.monochrome.end(), [&](const PsfCurve& curve) {
        return curve.airy_diameter_px > other || curve.energy_outside > largest_share_outside;
      });
}

std::string band_name(const PsfReport& report) {
  const auto [low, high] = std::minmax_element(
      report.monochrome.begin(), report.monochrome.end(),
      [](const PsfCurve& a, const PsfCurve& b) { return a.wavelength_nm < b.wavelength_nm; });
  return fmt::format("{:g} to {:g} nm", low->wavelength_nm, high->wavelength_nm);
}

}  // namespace

PsfReport measure_psf(const Lens& lens, double depth_units, int width_px,
                      const std::vector<double>& wavelengths_nm,
                      const std::function<void(double)>& progress) {
  validate(wavelengths_nm);
  const PointImage image = image_of_point(lens, depth_units, width_px);
  const auto [low, high] = std::minmax_element(wavelengths_nm.begin(), wavelengths_nm.end());
  const double shortest_m = *low * metres_per_nm, longest_m = *high * metres_per_nm;
  PsfReport report;
  report.coc_diameter_px = 2 * geometric_radius_m(image) / image.pixel_m;
  report.pixel_um = 1e6 * image.pixel_m;
  report.fresnel_zones = fresnel_zones(image, shortest_m);
  report.radii_px = sample_radii_px(image, shortest_m, longest_m);
  report.geometric_per_px2 = geometric_density(report);
  for (const double nm : wavelengths_nm) {
    report.monochrome.push_back(measure_curve(image, nm, report));
  }
  const std::vector<double> band_m = band_samples(image, shortest_m, longest_m);
  report.broadband_per_px2 = measure_broadband(image, band_m, report, progress);
  report.diffraction_matters = does_diffraction_matter(report);
  return report;
}

Plot psf_plot(const PsfReport& report, bool is_log) {
  double largest = 0;
  for (const PsfCurve& curve : report.monochrome) {
    largest = std::max(largest, curve.density_per_px2.front());
    for (const double density : curve.density_per_px2) largest = std::max(largest, density);
  }
  const double floor = is_log ? chart_floor * largest : 0;
  Plot plot{
      fmt::format("PSF: CoC diameter {:.4g} px, pixel {:.4g} um", report.coc_diameter_px,
                  report.pixel_um),
      "radius, px",
      is_log ? "energy per square pixel (down to 1e-6 of the largest)" : "energy per square pixel"};
  plot.y_log = is_log;
  const auto add = [&](const std::string& name, const std::vector<double>& density) {
    Series series{name, {}, true, false};
    for (std::size_t i = 0; i < density.size(); ++i) {
      series.points.push_back({report.radii_px[i], std::max(density[i], floor)});
    }
    plot.series.push_back(std::move(series));
  };
  if (report.coc_diameter_px > 0) add("geometric", report.geometric_per_px2);
  for (const PsfCurve& curve : report.monochrome) {
    add(fmt::format("{:g} nm", curve.wavelength_nm), curve.density_per_px2);
  }
  if (report.monochrome.size() > 1) add(band_name(report), report.broadband_per_px2);
  plot.series.push_back({"half a pixel", {{0.5, floor}, {0.5, largest}}, true, false});
  return plot;
}

void write_psf_csv(const std::string& path, const PsfReport& report) {
  std::string csv = "radius_px,radius_um,geometric,broadband";
  for (const PsfCurve& c : report.monochrome) csv += fmt::format(",{}nm", c.wavelength_nm);
  for (std::size_t i = 0; i < report.radii_px.size(); ++i) {
    const double r = report.radii_px[i];
    csv += fmt::format("\n{:.8g},{:.8g},{:.8g},{:.8g}", r, r * report.pixel_um,
                       report.geometric_per_px2[i], report.broadband_per_px2[i]);
    for (const PsfCurve& c : report.monochrome) {
      csv += fmt::format(",{:.8g}", c.density_per_px2[i]);
    }
  }
  write_text(path, csv + "\n");
}

}  // namespace defray
