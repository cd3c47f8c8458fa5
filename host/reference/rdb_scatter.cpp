// Twin of kernels/rdb/rdb_scatter.cl: Shinya 1994, section 4, steps 2 to 4.
#include <algorithm>
#include <array>
#include <cmath>

#include "reference/pcg3d.h"
#include "reference/reference.h"

namespace defray::reference {
namespace {

struct Offset {
  double u, v;
};

/// Offset of a target pixel's lens points: uniform in [-half, half)^2 in steps of the lens unit.
Offset jitter_offset(std::uint32_t x, std::uint32_t y, std::uint32_t seed, std::int32_t half) {
  const auto hash = pcg3d(x, y, seed);
  const double unit = std::ldexp(1.0, -DEFRAY_LENS_FRACTION_BITS);
  const auto offset = [&](std::uint32_t h) {
    return (std::floor(std::ldexp(static_cast<double>(h), -32) * 2 * half) - half) * unit;
  };
  return {offset(hash[0]), offset(hash[1])};
}

/// A ray displaced by `ray` pixels arrives at a pixel `step` away if the step is in its square.
bool arrives(double step, double ray) { return step - ray >= -0.5 && step - ray < 0.5; }

/// Rays of a radius below 1 px may land as those of another, quanta.
double lands_as(const LensPoints& lens, std::int32_t radius) {
  const auto& radii = lens.landing_radii;
  const double own = radius;
  if (!(std::fabs(own) < static_cast<double>(radii.size()))) return own;
  return std::copysign(radii[static_cast<std::size_t>(std::fabs(own))], own);
}

/// One lens point's scatter over a frame.
class CellScatter {
 public:
  CellScatter(const Frame& f, const RayPlan& plan, std::size_t cell)
      : width_(f.width),
        height_(f.height),
        jitter_(plan.lens.jitter),
        seed_(plan.seed),
        origin_x_(plan.origin_x),
        origin_y_(plan.origin_y),
        cell_(cell) {
    u_ = std::ldexp(static_cast<double>(plan.lens.points[cell][0]), -DEFRAY_LENS_FRACTION_BITS);
    v_ = std::ldexp(static_cast<double>(plan.lens.points[cell][1]), -DEFRAY_LENS_FRACTION_BITS);
    half_ = std::ldexp(static_cast<double>(plan.lens.jitter), -DEFRAY_LENS_FRACTION_BITS);
  }

  /// Calls visit(target index) for each target pixel that source (px, py) of radius r reaches.
  template <typename Visit>
  void for_each_target(int px, int py, double r, const Visit& visit) const {
    const double spread = std::fabs(r) * half_ + 1;
    const int y0 = first(py + r * v_ - spread, height_), y1 = last(py + r * v_ + spread, height_);
    const int x0 = first(px + r * u_ - spread, width_), x1 = last(px + r * u_ + spread, width_);
    for (int y = y0; y <= y1; ++y) {
      for (int x = x0; x <= x1; ++x) {
        if (reaches(x, y, px, py, r)) visit(size(y) * width() + size(x));
      }
    }
  }

  /// How far from its source a ray of radius r ends, without jitter.
  std::array<double, 2> lands_at(double r) const {
    return {std::ceil(r * u_ - 0.5), std::ceil(r * v_ - 0.5)};
  }

  /// Whether a fragment that covers this share of its pixel sends a ray: the fractions of
  /// k rho + h, h a pixel's own, fill 0 to 1 evenly (rho: 1 / the plastic number, 16 bits of it).
  bool sends(int px, int py, double share) const {
    const double turn = (pcg3d(absolute_x(px), absolute_y(py), 0)[2] % 65536) / 65536.0;
    const double at = static_cast<double>(cell_) * (49471.0 / 65536) + turn;
    return at - std::floor(at) < share;
  }

 private:
  std::uint32_t absolute_x(int x) const { return static_cast<std::uint32_t>(x + origin_x_); }
  std::uint32_t absolute_y(int y) const { return static_cast<std::uint32_t>(y + origin_y_); }
  std::size_t width() const { return size(width_); }
  static int first(double at, int size) {
    return static_cast<int>(std::clamp(std::floor(at), 0.0, static_cast<double>(size)));
  }
  static int last(double at, int size) {
    return static_cast<int>(std::clamp(std::ceil(at), -1.0, size - 1.0));
  }

  bool reaches(int x, int y, int px, int py, double r) const {
    Offset delta{0, 0};
    if (jitter_ != 0) delta = jitter_offset(absolute_x(x), absolute_y(y), seed_, jitter_);
    const double u = u_ + delta.u, v = v_ + delta.v;
    return u * u + v * v <= 1 && arrives(x - px, r * u) && arrives(y - py, r * v);
  }

  int width_, height_;
  std::int32_t jitter_;
  std::uint32_t seed_;
  int origin_x_, origin_y_;
  std::size_t cell_;
  double u_, v_, half_;
};

}  // namespace

std::vector<std::int64_t> rdb_scatter(const Frame& f, const RayPlan& plan, std::size_t cell) {
  const CellScatter scatter(f, plan, cell);
  std::vector<std::int64_t> winner(f.pixels(), -1);
  std::vector<std::int32_t> nearest(f.pixels());  // radii as which they won
  const auto depth = f.depth.host();
  const auto coc = f.coc_quanta.host();
  const auto coverage = f.coverage.host();
  for (std::size_t source = 0; source < depth.size(); ++source) {
    if (!is_fragment(depth[source])) continue;
    const int x = static_cast<int>(source % size(f.width));
    const int y = static_cast<int>(source / size(f.width) / size(f.layers));
    if (!coverage.empty() && !scatter.sends(x, y, (coverage[source] & 0x7fffffffu) / 65536.0)) {
      continue;
    }
    const auto reach_as = [&](std::int32_t radius) {
      const double r = std::ldexp(lands_as(plan.lens, radius), -DEFRAY_COC_FRACTION_BITS);
      scatter.for_each_target(x, y, r, [&](std::size_t target) {
        // Sources come in index order: an equal radius never replaces an earlier one.
        if (winner[target] >= 0 && radius >= nearest[target]) return;
        winner[target] = static_cast<std::int64_t>(source);
        nearest[target] = radius;
      });
    };
    if (plan.lens.jitter != 0) {
      reach_as(coc[source]);
      continue;
    }
    const Span span = span_of(f, plan, source);
    const auto offset = [&](std::int32_t radius) {
      return scatter.lands_at(std::ldexp(lands_as(plan.lens, radius), -DEFRAY_COC_FRACTION_BITS));
    };
    reach_as(span.least);
    if (offset(span.least) == offset(span.largest)) continue;  // and so do those between
    for (std::int32_t radius = span.least + 1; radius <= span.largest; ++radius) {
      if (offset(radius) != offset(radius - 1)) reach_as(radius);
    }
  }
  return winner;
}

}  // namespace defray::reference
