#include "splat/view.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "lens/lens.h"

namespace defray {
namespace {

constexpr int largest_side = 16384;
/// Of cameras and what they look at, from the scene's origin: floats hold squares of more than
/// this.
constexpr double farthest_camera = 1e18;

Vec3 vec(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }

/// Unit axes of the picture.
struct Axes {
  Vec3 right, down, forward;
};

void check_finite(const CameraPose& pose) {
  for (const auto* v : {&pose.from, &pose.look_at, &pose.up}) {
    for (const double value : *v) {
      if (!std::isfinite(value)) {
        fail(ErrorKind::usage, "{}, {} and {} must be finite numbers", field("from"),
             field("look_at"), field("up"));
      }
    }
  }
}

/// Farther ones' squares are not numbers.
void check_place(const char* name, const std::array<double, 3>& place) {
  for (const double along : place) {
    if (std::fabs(along) <= farthest_camera) continue;
    fail(ErrorKind::usage,
         "{} {:g},{:g},{:g} is too far away: allowed are {:g} units along each axis", field(name),
         place[0], place[1], place[2], farthest_camera);
  }
}

Axes axes_of(const CameraPose& pose) {
  check_finite(pose);
  check_place("from", pose.from);
  check_place("look_at", pose.look_at);
  const Vec3 towards = vec(pose.look_at) - vec(pose.from);
  if (!(length(towards) > 0)) {
    fail(ErrorKind::usage, "{} and {} are the same place: the camera looks nowhere", field("from"),
         field("look_at"));
  }
  const auto& up = pose.up;
  const double longest = std::max({std::fabs(up[0]), std::fabs(up[1]), std::fabs(up[2])});
  const Vec3 forward = normalized(towards), right = cross(forward, vec(up) / longest);
  if (!(length(right) > 1e-9)) {  // nor where up is 0
    fail(ErrorKind::usage,
         "{} {:g},{:g},{:g} is 0, or where the camera looks: it must lie beside that, as {} does",
         field("up"), up[0], up[1], up[2], std::fabs(forward.z) < 0.9 ? "0,0,1" : "0,1,0");
  }
  const Vec3 unit = normalized(right);
  return {unit, cross(forward, unit), forward};
}

void put(const Vec3& v, float& x, float& y, float& z) {
  x = static_cast<float>(v.x);
  y = static_cast<float>(v.y);
  z = static_cast<float>(v.z);
}

void put_lens(const Lens& lens, int width, DefraySplatParams& p) {
  validate(lens);
  if (lens.focus_end_units != 0) {
    fail(ErrorKind::usage, "{}: splats have one plane of focus", field("focus_end_units"));
  }
  // The largest CoC that a kernel's numbers hold without loss; more has left every picture.
  constexpr double most_px = 1 << 20;
  p.focal_px = static_cast<float>(pixel_focal_length(lens, width));
  p.near_units = static_cast<float>(lens.focal_length_mm / 1000 / lens.metres_per_unit);
  p.focus_is_infinite = std::isinf(lens.focus_distance_units);
  p.coc_scale_px = static_cast<float>(background_coc_px(lens, width));
  p.focus_units = p.focus_is_infinite ? 0 : static_cast<float>(lens.focus_distance_units);
  p.infinite_focus_scale = static_cast<float>(infinite_focus_scale(lens, width));
  p.lens_units = lens_radius_of(p);
  p.limit_px =
      static_cast<float>(lens.max_coc_px > 0 ? std::min(lens.max_coc_px, most_px) : most_px);
}

}  // namespace

void validate(const SplatSettings& s) {
  if (s.width < 1 || s.height < 1 || s.width > largest_side || s.height > largest_side) {
    fail(ErrorKind::usage, "a picture of {}x{} pixels: allowed are 1 to {} a side", s.width,
         s.height, largest_side);
  }
  require_named("psf", s.psf, SplatPsf::disc);
  require_named("merge", s.merge, SplatMerge::average);
  if (!(s.cutoff >= 2 && s.cutoff <= 3)) {
    fail(ErrorKind::usage, "{} is {}: allowed are 2 to 3", field("cutoff"), s.cutoff);
  }
  if (s.layers < 0) {
    fail(ErrorKind::usage, "{} is {}: allowed are 1 on, and 0 for all", field("layers"), s.layers);
  }
  if (!(s.transparency >= 0 && s.transparency < 1)) {
    fail(ErrorKind::usage, "{} is {}: allowed are 0 to below 1", field("transparency"),
         s.transparency);
  }
}

float lens_radius_of(const DefraySplatParams& p) {
  // coc = K (z - z0) / z with K = A F / (2 z0): the lens's radius is K z0 / F.
  const double scale_px = p.focus_is_infinite ? static_cast<double>(p.infinite_focus_scale)
                                              : static_cast<double>(p.coc_scale_px) * p.focus_units;
  return static_cast<float>(scale_px / p.focal_px);
}

/// Sums of Gaussians that end earlier are less even: with so much more those of even balls (1000 to
/// 300 000 points) are no less than 1.002 at c = 2, without it than 0.976.
constexpr double even_cutoff = 2.5, more_for_edges = 0.5;

void put_cutoff(double cutoff, DefraySplatParams& p) {
  const double edge = std::exp(-cutoff), share = 1 - edge * (1 + cutoff);
  p.cutoff = static_cast<float>(cutoff);
  p.edge = static_cast<float>(edge);
  p.gaussian_share = static_cast<float>(share);
  p.aim = static_cast<float>(1 + more_for_edges * std::max(edge - std::exp(-even_cutoff), 0.0));
  p.gaussian_variance = static_cast<float>(1 - cutoff * cutoff * edge / (2 * share));
}

DefraySplatParams splat_params(const CameraPose& pose, const std::array<double, 3>& origin,
                               const Lens& lens, const SplatSettings& settings) {
  DefraySplatParams p{};
  p.width = static_cast<std::uint32_t>(settings.width);
  p.height = static_cast<std::uint32_t>(settings.height);
  const Axes axes = axes_of(pose);
  put(axes.right, p.right_x, p.right_y, p.right_z);
  put(axes.down, p.down_x, p.down_y, p.down_z);
  put(axes.forward, p.forward_x, p.forward_y, p.forward_z);
  put(vec(pose.from) - vec(origin), p.eye_x, p.eye_y, p.eye_z);
  p.centre_x = static_cast<float>(settings.width) / 2;
  p.centre_y = static_cast<float>(settings.height) / 2;
  put_lens(lens, settings.width, p);
  put_cutoff(settings.cutoff, p);
  p.has_discs = settings.psf == SplatPsf::disc;
  p.averages = settings.merge == SplatMerge::average;
  p.layers = settings.layers > 0 ? settings.layers : std::numeric_limits<std::int32_t>::max();
  return p;
}

double framing_distance(double radius, const Lens& lens, const SplatSettings& settings) {
  const double focal = pixel_focal_length(lens, settings.width);
  const double half_side = std::min(settings.width, settings.height) / 2.0;
  return 1.1 * radius * std::hypot(focal, half_side) / half_side;
}

double splat_coc_px(const DefraySplatParams& p, double z) {
  const double radius = p.focus_is_infinite ? -static_cast<double>(p.infinite_focus_scale) / z
                                            : static_cast<double>(p.coc_scale_px) *
                                                  (z - static_cast<double>(p.focus_units)) / z;
  return std::clamp(radius, -static_cast<double>(p.limit_px), static_cast<double>(p.limit_px));
}

}  // namespace defray
