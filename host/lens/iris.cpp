#include "lens/iris.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace defray {
namespace {

using std::numbers::pi;

/// Steps of half a blade's angle: the area between them is known to 1e-7.
constexpr int steps = 1024;

}  // namespace

Iris::Iris(const Aperture& a) : blades_(a.blades) {
  if (blades_ == 0) return;
  // Counter-clockwise with v down; modulo a turn, so that no angle is too large to be exact.
  rotation_ = -std::fmod(a.rotation_deg, 360) * pi / 180;
  const double to_corner = pi / blades_;
  const double half_chord = std::sin(to_corner);
  const double sagitta = a.curvature * (1 - std::cos(to_corner));
  apothem_ = std::cos(to_corner) + sagitta;
  bend_ = 2 * sagitta / (half_chord * half_chord + sagitta * sagitta);
  for (int i = 0; i < blades_; ++i) {
    const double angle = rotation_ + 2 * to_corner * i;
    middles_.push_back({std::cos(angle), std::sin(angle)});
  }
  area_.push_back(0);
  for (int i = 0; i < steps; ++i) {
    const double radius = radius_at(to_corner * (i + 0.5) / steps);
    area_.push_back(area_.back() + radius * radius);
  }
  for (double& area : area_) area /= area_.back();
}

double Iris::radius_at(double angle) const {
  const double half_bend = bend_ / 2;
  const double slope = std::cos(angle) * (1 - bend_ * apothem_);
  const double at_centre = apothem_ * (half_bend * apothem_ - 1);
  // The smaller root of half_bend r^2 + slope r + at_centre, exact for half_bend -> 0 too. Edges
  // that touch the next blade's (four blades, -1) round to just below 0 there.
  const double root = std::sqrt(std::max(0.0, slope * slope - 4 * half_bend * at_centre));
  return -2 * at_centre / (slope + root);
}

double Iris::beyond_edge(double u, double v) const {
  const double beyond_disc = std::sqrt(u * u + v * v) - 1;  // hypot takes five times as long
  if (blades_ == 0) return beyond_disc;
  const double blade_angle = 2 * pi / blades_;
  const long turned = std::lround((std::atan2(v, u) - rotation_) / blade_angle) + 2 * blades_;
  const auto [x_u, x_v] = middles_[static_cast<std::size_t>(turned % blades_)];
  const double t = u * x_u + v * x_v - apothem_;
  const double y = v * x_u - u * x_v;
  return std::max(beyond_disc, t + bend_ / 2 * (t * t + y * y));
}

Iris::Edge Iris::edge_at_share(double share) const {
  if (blades_ == 0) return {2 * pi * share, 1};
  // Of the blade's two halves the second counts from its middle on, the first mirrored.
  const double blade = std::round(share * blades_);
  const double of_half = std::clamp(2 * (share * blades_ - blade), -1.0, 1.0);
  const auto above = std::upper_bound(area_.begin() + 1, area_.end() - 1, std::fabs(of_half));
  const double step = static_cast<double>(above - area_.begin()) - 1;
  const double part = (std::fabs(of_half) - *(above - 1)) / (*above - *(above - 1));
  const double from_middle = std::copysign((step + part) / steps * pi / blades_, of_half);
  return {rotation_ + blade * 2 * pi / blades_ + from_middle, radius_at(from_middle)};
}

}  // namespace defray
