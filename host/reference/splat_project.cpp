// Twin of kernels/splat/splat_project.cl: Krivanek & Zara 2003, sections 4.2, 5.2, 5.3, appendix A.
#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "reference/twin_backend.h"
#include "splat/splats.h"

namespace defray::reference {
namespace {

using Row = std::array<float, 3>;

float dot(const Row& a, const Row& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// A node from the lens's centre: its normal, the Jacobian's rows, how far the eye is behind its
/// plane, and, px, what a unit of area covers, and what all of it would a unit before the eye.
struct Seen {
  Row normal, to_x, to_y;
  float towards, spread, size;
};

/// A symmetric matrix of the scene.
struct Covariance {
  std::array<Row, 3> rows;
  float between(const Row& a, const Row& b) const {
    return dot(a, {dot(rows[0], b), dot(rows[1], b), dot(rows[2], b)});
  }
};

/// V_q.
Covariance low_pass_of(const DefraySplatNode& n) {
  return {{Row{n.low_xx, n.low_xy, n.low_xz}, Row{n.low_xy, n.low_yy, n.low_yz},
           Row{n.low_xz, n.low_yz, n.low_zz}}};
}

/// One of the picture.
struct Variance {
  float xx, xy, yy;
};

float coc_px(const DefraySplatParams& p, float z) {
  return p.focus_is_infinite ? -p.infinite_focus_scale / z
                             : p.coc_scale_px * ((z - p.focus_units) / z);
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

/// Eigenvalues of m, each at least `circle`, or, of discs, with it, in m's axes.
Around circumellipse(const Variance& m, float circle, bool is_disc) {
  const float mean = 0.5f * (m.xx + m.yy), difference = 0.5f * (m.xx - m.yy);
  const float spread = std::sqrt(difference * difference + m.xy * m.xy);
  const float most = mean + spread, least = std::fmax(mean - spread, 0.0f);
  const float largest = is_disc ? most + circle : std::fmax(most, circle);
  const float smallest = is_disc ? least + circle : std::fmax(least, circle);
  if (spread == 0) return {{largest, 0, largest}, largest};
  const float middle = 0.5f * (largest + smallest), half = 0.5f * (largest - smallest) / spread;
  return {{middle + half * difference, half * m.xy, middle - half * difference}, smallest};
}

/// Of own + prefilter I + around; own's is root^2.
float determinant_of(const Variance& own, float root, float prefilter, const Around& around) {
  const float circle = prefilter + around.circle;
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

/// A disc of variance 1 - share, blurred by a Gaussian of the rest.
struct BlurredDisc {
  float end, fall, bulge, whole;
};

BlurredDisc blurred_disc(float share) {
  const float size = std::sqrt(share);
  BlurredDisc d{};
  d.fall = 15.8f * (size * std::sqrt(1 - share));
  d.bulge = std::fmin(std::fmax(2.54f - 5.4f * size, 0.0f), 2.0f);
  const float first = 0.333333343f + 0.0833333358f * d.bulge, second = 0.25f + 0.05f * d.bulge;
  const float flat = d.fall * (1 - first);
  const float square = flat * flat + 4 - d.fall * d.fall * (1 - 2 * second);
  d.end = flat + 2 + std::sqrt(std::fmax(square, 0.0f));
  d.whole = d.end - flat;
  return d;
}

/// Returns the share of `blur`.
float set_shape(const DefraySplatParams& p, const Variance& w, float determinant, float size,
                float blur, bool is_disc, DefraySplat& s) {
  const float root = std::sqrt(determinant);
  float reach = 2 * p.cutoff, form = 0.5f;
  s.amplitude = p.aim * size / (6.28318531f * root * p.gaussian_share);
  if (is_disc) {
    const float gaussian = std::fmax(root - blur, p.gaussian_variance);
    const BlurredDisc d = blurred_disc(std::fmin(gaussian / root, 0.4f));
    form = 1 / d.fall;
    reach = d.end;
    s.amplitude = p.aim * size / (3.14159274f * (root * d.whole));
    s.disc_top = d.end / d.fall;
    s.disc_bulge = d.bulge;
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
  return blur / root;
}

/// Towards the camera.
float half_depth_of(const DefraySplatParams& p, const DefraySplatNode& n, const Row& forward,
                    const Row& normal) {
  const Covariance low = low_pass_of(n);
  const float slant = dot(forward, normal);
  const float along = n.variance * (1 - slant * slant) + low.between(forward, forward);
  return std::fmax(std::sqrt(2 * p.cutoff * along), std::sqrt(n.variance));
}

/// What a node names, and what becomes of it; or nothing.
struct Ridges {
  std::span<const DefraySplatRidge> from;
  DefraySplatLine* to;
};

/// The kernel's end at a ridge. `around`: the variance of blur and prefilter in `w`.
DefraySplatLine end_at_ridge(const DefraySplatRidge& ridge, const Seen& seen, const Variance& own,
                             float around, const Variance& w, float determinant, float sharp) {
  const Row foot{ridge.x, ridge.y, ridge.z}, &n = seen.normal;
  const Row along{foot[1] * n[2] - foot[2] * n[1], foot[2] * n[0] - foot[0] * n[2],
                  foot[0] * n[1] - foot[1] * n[0]};
  const float run_x = dot(seen.to_x, along), run_y = dot(seen.to_y, along);
  const float run = std::sqrt(run_x * run_x + run_y * run_y);
  if (!(run > 0)) return {1, 0, 0, 1 - sharp};
  const float far = (run_x * dot(seen.to_y, foot) - run_y * dot(seen.to_x, foot)) / run;
  const float side = far < 0 ? -run : run;
  const float x = -run_y / side, y = run_x / side;
  const float own_x = own.xx * x + own.xy * y, own_y = own.xy * x + own.yy * y;
  const float slope_x = (w.yy * own_x - w.xy * own_y) / determinant;
  const float slope_y = (w.xx * own_y - w.xy * own_x) / determinant;
  const float spread = around * (x * slope_x + y * slope_y);
  const float steep = sharp * (0.288675135f / std::sqrt(std::fmax(spread, 0.01f)));
  return {1 - 0.48f * sharp + std::fabs(far) * steep, -slope_x * steep, -slope_y * steep,
          1 - sharp};
}

/// Returns the share of `blur`.
float blur_node(const DefraySplatParams& p, const DefraySplatNode& n, const Seen& seen, float blur,
                bool is_disc, const Ridges& ridges, DefraySplat& s) {
  const Covariance low = low_pass_of(n);
  const Row &to_x = seen.to_x, &to_y = seen.to_y;
  const Around added = circumellipse(
      {low.between(to_x, to_x), low.between(to_x, to_y), low.between(to_y, to_y)}, blur, is_disc);
  const float kept = is_disc ? p.gaussian_variance : 1, basis = kept * n.variance;
  const float over_x = dot(to_x, seen.normal), over_y = dot(to_y, seen.normal);
  const Variance own{basis * (dot(to_x, to_x) - over_x * over_x),
                     basis * (dot(to_x, to_y) - over_x * over_y),
                     basis * (dot(to_y, to_y) - over_y * over_y)};
  const Variance w{own.xx + kept + added.all.xx, own.xy + added.all.xy,
                   own.yy + kept + added.all.yy};
  const float determinant = determinant_of(own, basis * seen.spread, kept, added);
  const float share = set_shape(p, w, determinant, seen.size, blur, is_disc, s);
  const float sharp = 1 - share * share;
  s.amplitude *= 1 + (n.cover - 1) * sharp;
  for (std::size_t i = 0; i < ridges.from.size(); ++i) {
    ridges.to[i] = end_at_ridge(ridges.from[i], seen, own, kept + blur, w, determinant, sharp);
  }
  return share;
}

/// How much is seen, from an amplitude of 1, from the point of the lens that each pixel stands for.
/// Returns whether any is.
bool face_lens(const DefraySplatParams& p, const Seen& seen, bool has_back, float coc,
               float sharp_coc, float share, DefraySplat& s) {
  s.back = has_back ? -1 : 0;
  const float x = dot({p.right_x, p.right_y, p.right_z}, seen.normal);
  const float y = dot({p.down_x, p.down_y, p.down_z}, seen.normal);
  const float units_a_px = sharp_coc != 0 ? share * (p.lens_units / sharp_coc) : 0;
  s.lean_x = s.amplitude * (units_a_px * x);
  s.lean_y = s.amplitude * (units_a_px * y);
  s.amplitude *= -seen.towards;
  const float most = std::fabs(coc * units_a_px) * std::sqrt(x * x + y * y);
  return has_back || most - seen.towards > 0;
}

DefraySplat project(const DefraySplatParams& p, const DefraySplatNode& n, const Ridges& ridges) {
  const Row right{p.right_x, p.right_y, p.right_z}, down{p.down_x, p.down_y, p.down_z};
  const Row forward{p.forward_x, p.forward_y, p.forward_z};
  const Row from_eye{n.x - p.eye_x, n.y - p.eye_y, n.z - p.eye_z};
  const float z = dot(forward, from_eye), size = size_of({n.area_x, n.area_y, n.area_z});
  Seen seen{.normal = {n.area_x / size, n.area_y / size, n.area_z / size}};

  DefraySplat depths{};
  const float half_depth = half_depth_of(p, n, forward, seen.normal);
  depths.z = z;
  depths.z_near = z - half_depth;
  depths.z_far = z + half_depth;
  if (!(size > 0) || !(depths.z_near > p.near_units)) return depths;

  const float scale = p.focal_px / z;
  const float tan_x = dot(right, from_eye) / z, tan_y = dot(down, from_eye) / z;
  for (std::size_t i = 0; i < 3; ++i) {
    seen.to_x[i] = scale * (right[i] - tan_x * forward[i]);
    seen.to_y[i] = scale * (down[i] - tan_y * forward[i]);
  }
  seen.towards = dot(seen.normal, from_eye);
  seen.spread = scale * scale * (std::fabs(seen.towards) / z);
  seen.size = scale * scale * (size / z);

  DefraySplat s = depths;
  s.x = p.centre_x + p.focal_px * tan_x;
  s.y = p.centre_y + p.focal_px * tan_y;
  const float facing = std::fabs(seen.towards) / std::sqrt(dot(from_eye, from_eye));
  const float light = p.has_headlight ? 0.333333343f + 0.666666687f * facing : 1;
  s.r = n.r * light;
  s.g = n.g * light;
  s.b = n.b * light;
  s.a = n.a;
  const DefraySplat without_shape = s;

  const float sharp_coc = coc_px(p, z), coc = std::clamp(sharp_coc, -p.limit_px, p.limit_px);
  const float own = 1 + scale * scale * n.variance;
  const bool is_disc = p.has_discs && coc * coc > DEFRAY_SPLAT_DISC * own;
  const float blur = (is_disc ? 0.25f : 0.36067376f) * (coc * coc);
  const float share = blur_node(p, n, seen, blur, is_disc, ridges, s);
  const bool has_back = n.both_sides > 0.5f || !p.one_sided;
  if (!face_lens(p, seen, has_back, coc, sharp_coc, share, s)) return depths;
  const float covered = std::fabs(s.amplitude) + std::fabs(s.lean_x) + std::fabs(s.lean_y);
  if (!(covered > 0)) return without_shape;
  if (s.first_x < s.end_x && s.first_y < s.end_y) {
    s.lines = n.ridges;
  } else {
    s.first_x = s.end_x = s.first_y = s.end_y = 0;
  }
  return s;
}

}  // namespace

Splats TwinBackend::splat_project(const Values<DefraySplatNode>& nodes,
                                  const Values<DefraySplatRidge>& ridges,
                                  const DefraySplatParams& params) {
  std::vector<DefraySplat> splats;
  splats.reserve(nodes.size());
  std::vector<DefraySplatLine> lines(ridges.size());
  for (const DefraySplatNode& node : nodes) {
    const std::size_t first = std::size_t{node.ridges} * DEFRAY_SPLAT_RIDGES;
    const std::size_t count = node.ridges == 0 ? 0 : DEFRAY_SPLAT_RIDGES;
    splats.push_back(
        project(params, node, {ridges.host().subspan(first, count), lines.data() + first}));
  }
  return {std::move(splats), std::move(lines)};
}

}  // namespace defray::reference
