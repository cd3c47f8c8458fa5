#include "measure/psf.h"

#include <cmath>
#include <numbers>

#include "base/error.h"

namespace defray {
namespace {

using std::numbers::pi;

constexpr int points = 16;  // of one Gauss-Legendre panel
constexpr int max_panels = 32768 / points;
constexpr double tolerance = 1e-10;
constexpr double first_zero_of_j1 = 3.8317059702075123;

struct Node {
  double at, weight;
};

/// Nodes and weights of a Gauss-Legendre panel on 0...1: Newton's method on the Legendre
/// polynomial from Tricomi's guess of its roots.
std::vector<Node> gauss_panel() {
  std::vector<Node> nodes;
  for (unsigned i = 0; i < points; ++i) {
    double x = std::cos(pi * (i + 0.75) / (points + 0.5)), slope = 0;
    for (int step = 0; step < 10; ++step) {
      const double p = std::legendre(points, x);
      slope = points * (x * p - std::legendre(points - 1, x)) / (x * x - 1);
      x -= p / slope;
    }
    nodes.push_back({(1 - x) / 2, 1 / ((1 - x * x) * slope * slope)});
  }
  return nodes;
}

/// The rule over 0...1 in equal panels.
std::vector<Node> composite_rule(int panels) {
  static const std::vector<Node> panel = gauss_panel();
  std::vector<Node> rule;
  for (int k = 0; k < panels; ++k) {
    for (const Node& node : panel) {
      rule.push_back({(k + node.at) / panels, node.weight / panels});
    }
  }
  return rule;
}

}  // namespace

PointImage image_of_point(const Lens& lens, double depth_units, int width_px) {
  validate(lens);
  if (!(lens.aperture_diameter_mm > 0)) {
    fail(ErrorKind::usage, "aperture diameter is 0: no light passes, there is no PSF");
  }
  if (!(depth_units > 0)) {
    fail(ErrorKind::usage, "{} is {}: it must be above 0 (inf is allowed)", field("depth"),
         depth_units);
  }
  if (width_px < 1 || width_px > 65536) {
    fail(ErrorKind::usage, "{} is {}: 1 to 65536 pixels are possible", field("width"), width_px);
  }
  const double f = lens.focal_length_mm / 1000;
  const double focus = lens.focus_distance_units * lens.metres_per_unit;
  PointImage image;
  image.aperture_radius_m = lens.aperture_diameter_mm / 2000;
  image.sensor_distance_m = f / (1 - f / focus);
  image.defocus_per_m = 1 / (depth_units * lens.metres_per_unit) - 1 / focus;
  image.pixel_m = lens.sensor_width_mm / 1000 / width_px;
  return image;
}

double geometric_radius_m(const PointImage& image) {
  return image.aperture_radius_m * std::fabs(image.defocus_per_m) * image.sensor_distance_m;
}

double airy_radius_m(const PointImage& image, double wavelength_m) {
  const double f_number = image.sensor_distance_m / (2 * image.aperture_radius_m);
  return first_zero_of_j1 / pi * wavelength_m * f_number;
}

double fresnel_zones(const PointImage& image, double wavelength_m) {
  return std::fabs(image.defocus_per_m) * std::pow(image.aperture_radius_m, 2) / wavelength_m;
}

DiffractionPsf::DiffractionPsf(const PointImage& image, double wavelength_m,
                               double largest_radius_m)
    : phase_(pi * image.defocus_per_m * std::pow(image.aperture_radius_m, 2) / wavelength_m),
      v_per_m_(2 * pi * image.aperture_radius_m / (wavelength_m * image.sensor_distance_m)),
      density_in_focus_(v_per_m_ * v_per_m_ / (4 * pi)) {
  // A panel of 16 nodes takes about three turns of the integrand.
  const double turns = (std::fabs(phase_) + v_per_m_ * largest_radius_m) / (2 * pi);
  double change = 1;
  for (double panels = 2 + std::floor(turns / 3); 2 * panels <= max_panels; panels *= 2) {
    set_panels(static_cast<int>(2 * panels));
    const auto axis = amplitude(0), rim = amplitude(largest_radius_m);
    set_panels(static_cast<int>(panels));  // kept if twice as many say the same
    change = std::max(std::abs(amplitude(0) - axis), std::abs(amplitude(largest_radius_m) - rim));
    if (change < tolerance) return;
  }
  fail(
      ErrorKind::usage,
      "the diffraction integral does not converge with {} nodes: {:.4g} Fresnel zones, radii up "
      "to {:.4g} Airy radii; so far from focus, or with such pixels, diffraction is nothing beside "
      "the geometric disc of {:.4g} px",
      max_panels * points, fresnel_zones(image, wavelength_m),
      largest_radius_m / airy_radius_m(image, wavelength_m),
      2 * geometric_radius_m(image) / image.pixel_m);
}

void DiffractionPsf::set_panels(int panels) {
  nodes_.clear();
  factors_.clear();
  for (const auto& [s, weight] : composite_rule(panels)) {
    nodes_.push_back(s);
    factors_.push_back(std::polar(2 * weight * s, phase_ * s * s));
  }
}

std::complex<double> DiffractionPsf::amplitude(double radius_m) const {
  std::complex<double> sum = 0;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    sum += factors_[i] * j0(v_per_m_ * radius_m * nodes_[i]);
  }
  return sum;
}

double DiffractionPsf::intensity(double radius_m) const { return std::norm(amplitude(radius_m)); }

double DiffractionPsf::encircled_energy(double radius_m) const {
  // By Parseval the whole plane holds int_0^inf I v dv = 2. No detail of I is finer than pi in v.
  const double v = v_per_m_ * radius_m;
  double energy = 0;
  for (const auto& [share, weight] : composite_rule(1 + static_cast<int>(v / (2 * pi)))) {
    energy += weight * intensity(share * radius_m) * share;
  }
  return energy * v * v / 2;
}

}  // namespace defray
