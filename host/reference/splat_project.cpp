// Twin of kernels/splat/splat_project.cl: Krivanek & Zara 2003, sections 4.2, 5.2, 5.3, appendix A.
#include <algorithm>
#include <array>
#include <cmath>

#include "reference/twin_backend.h"

namespace defray::reference {
namespace {

using Row = std::array<float, 3>;

float dot(const Row& a, const Row& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// A symmetric matrix of the scene.
struct Covariance {
  std::array<Row, 3> rows;
  float between(const Row& a, const Row& b) const {
    return dot(a, {dot(rows[0], b), dot(rows[1], b), dot(rows[2], b)});
  }
};

/// One of the picture.
struct Variance {
  float xx, xy, yy;
};

float coc_px(const DefraySplatParams& p, float z) {
  const float radius = p.focus_is_infinite ? -p.infinite_focus_scale / z
                                           : p.coc_scale_px * ((z - p.focus_units) / z);
  return std::clamp(radius, -p.limit_px, p.limit_px);
}

/// A variance in an axis and a circle's in all directions.
struct Around {
  Variance all;
  float circle;
};

/// Areas' squares are beyond floats.
float size_of(const Row& a) {
  const float largest = std::fmax(std::fmax(std::fabs(a[0]), std::fabs(a[1])), std::fabs(a[2]));
  if (!(largest > 0)) return 0;
  const Row share{a[0] / largest, a[1] / largest, a[2] / largest};
  return largest * std::sqrt(dot(share, share));
}

/// Eigenvalues of m, each at least `circle`, in m's axes.
Around circumellipse(const Variance& m, float circle) {
  const float mean = 0.5f * (m.xx + m.yy), difference = 0.5f * (m.xx - m.yy);
  const float spread = std::sqrt(difference * difference + m.xy * m.xy);
  const float largest = mean + spread;
  if (largest <= circle) return {{circle, 0, circle}, circle};
  if (spread == 0) return {{largest, 0, largest}, largest};
  const float smallest = std::fmax(mean - spread, circle);
  const float middle = 0.5f * (largest + smallest), half = 0.5f * (largest - smallest) / spread;
  return {{middle + half * difference, half * m.xy, middle - half * difference}, smallest};
}

/// Of own + I + around; own's is root^2.
float determinant_of(const Variance& own, float root, const Around& around) {
  const float circle = 1 + around.circle;
  const Variance axis{around.all.xx - around.circle, around.all.xy, around.all.yy - around.circle};
  const float mixed = own.xx * axis.yy + own.yy * axis.xx - 2 * (own.xy * axis.xy);
  const float traces = own.xx + own.yy + axis.xx + axis.yy;
  return root * root + circle * traces + circle * circle + std::fmax(mixed, 0.0f);
}

/// Where the pixels whose centres lie between two places begin and end, in a picture.
std::array<std::int32_t, 2> pixels_between(float from, float to, std::uint32_t side) {
  const auto limited = [&](float edge) {
    return static_cast<std::int32_t>(std::fmin(std::fmax(edge, 0.0f), static_cast<float>(side)));
  };
  return {limited(std::ceil(from - 0.5f)), limited(std::floor(to - 0.5f) + 1)};
}

void set_shape(const DefraySplatParams& p, const Variance& w, float determinant, float mass,
               bool is_disc, DefraySplat& s) {
  const float root = std::sqrt(determinant);
  float reach = 2 * p.cutoff, form = 0.5f;
  s.amplitude = mass / (6.28318531f * root * p.gaussian_share);
  if (is_disc) {
    form = 0.25f;
    s.disc_px = 2 * std::sqrt(root);
    s.amplitude = mass / (12.5663706f * root + 0.261799388f);
    const float edge = 1 + 0.5f / s.disc_px;
    reach = 4 * edge * edge;
  }
  const float share = form / determinant;
  s.conic_xx = w.yy * share;
  s.conic_xy = -w.xy * share;
  s.conic_yy = w.xx * share;
  const float half_x = std::sqrt(reach * w.xx), half_y = std::sqrt(reach * w.yy);
  const auto columns = pixels_between(s.x - half_x, s.x + half_x, p.width);
  const auto rows = pixels_between(s.y - half_y, s.y + half_y, p.height);
  s.first_x = columns[0];
  s.end_x = columns[1];
  s.first_y = rows[0];
  s.end_y = rows[1];
}

/// Nothing but its depths: no pixels.
DefraySplat culled(DefraySplat s) {
  s.first_x = s.end_x = s.first_y = s.end_y = 0;
  return s;
}

DefraySplat project(const DefraySplatParams& p, const DefraySplatNode& n) {
  const Row right{p.right_x, p.right_y, p.right_z}, down{p.down_x, p.down_y, p.down_z};
  const Row forward{p.forward_x, p.forward_y, p.forward_z};
  const Row from_eye{n.x - p.eye_x, n.y - p.eye_y, n.z - p.eye_z};
  const Row area{n.area_x, n.area_y, n.area_z};
  const Covariance low{{Row{n.low_xx, n.low_xy, n.low_xz}, Row{n.low_xy, n.low_yy, n.low_yz},
                        Row{n.low_xz, n.low_yz, n.low_zz}}};
  const float z = dot(forward, from_eye);
  const float size = size_of(area);
  const Row normal{area[0] / size, area[1] / size, area[2] / size};

  DefraySplat s{};
  const float slant = dot(forward, normal);
  const float along = n.variance * (1 - slant * slant) + low.between(forward, forward);
  const float half_depth = std::fmax(std::sqrt(2 * p.cutoff * along), std::sqrt(n.variance));
  s.z = z;
  s.z_near = z - half_depth;
  s.z_far = z + half_depth;
  if (!(size > 0) || !(s.z_near > p.near_units)) return culled(s);
  const float towards = dot(normal, from_eye);
  if (p.one_sided && !(towards < 0)) return culled(s);

  const float tan_x = dot(right, from_eye) / z, tan_y = dot(down, from_eye) / z;
  const float scale = p.focal_px / z;
  const float spread = scale * scale * (std::fabs(towards) / z), mass = spread * size;
  s.x = p.centre_x + p.focal_px * tan_x;
  s.y = p.centre_y + p.focal_px * tan_y;
  Row to_x, to_y;  // the Jacobian
  for (std::size_t i = 0; i < 3; ++i) {
    to_x[i] = scale * (right[i] - tan_x * forward[i]);
    to_y[i] = scale * (down[i] - tan_y * forward[i]);
  }
  const float coc = coc_px(p, z);
  const bool is_disc =
      p.has_discs && std::fabs(coc) > DEFRAY_SPLAT_DISC * (1 + scale * std::sqrt(n.variance));
  const float blur = (is_disc ? 0.25f : 0.36067376f) * (coc * coc);
  const Around added = circumellipse(
      {low.between(to_x, to_x), low.between(to_x, to_y), low.between(to_y, to_y)}, blur);
  const float over_x = dot(to_x, normal), over_y = dot(to_y, normal);
  const Variance own{n.variance * (dot(to_x, to_x) - over_x * over_x),
                     n.variance * (dot(to_x, to_y) - over_x * over_y),
                     n.variance * (dot(to_y, to_y) - over_y * over_y)};
  const Variance w{own.xx + 1 + added.all.xx, own.xy + added.all.xy, own.yy + 1 + added.all.yy};
  const float facing = std::fabs(towards) / std::sqrt(dot(from_eye, from_eye));
  const float light = p.has_headlight ? 0.333333343f + 0.666666687f * facing : 1;
  s.r = n.r * light;
  s.g = n.g * light;
  s.b = n.b * light;
  s.a = n.a;
  if (!(mass > 0)) return culled(s);
  set_shape(p, w, determinant_of(own, n.variance * spread, added), mass, is_disc, s);
  return s.first_x < s.end_x && s.first_y < s.end_y ? s : culled(s);
}

}  // namespace

Values<DefraySplat> TwinBackend::splat_project(const Values<DefraySplatNode>& nodes,
                                               const DefraySplatParams& params) {
  std::vector<DefraySplat> splats;
  splats.reserve(nodes.size());
  for (const DefraySplatNode& node : nodes) splats.push_back(project(params, node));
  return splats;
}

}  // namespace defray::reference
