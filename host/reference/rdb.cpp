// Twins of kernels/rdb/rdb_scatter.cl, rdb_merge.cl (Shinya 1994, section 4, steps 2 to 5) and
// rdb_nearest.cl.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>

#include "lens/cats_eye.h"
#include "reference/pcg3d.h"
#include "reference/reference.h"
#include "reference/twin_backend.h"

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

namespace {

/// Whether a surface goes on across a step, in view of those before and after it.
bool goes_on(double before, double step, double after) {
  const auto is_like = [&](double other) {
    return std::fabs(other) <= DEFRAY_RAMP_QUANTA && std::fabs(step - other) <= DEFRAY_BEND_QUANTA;
  };
  if (!(std::fabs(step) <= DEFRAY_RAMP_QUANTA)) return false;
  return std::fabs(step) <= DEFRAY_JUMP_QUANTA || is_like(before) || is_like(after);
}

}  // namespace

Span span_of(const Frame& f, const RayPlan& plan, std::size_t surface) {
  const std::int32_t own = f.coc_quanta[surface];
  Span span{own, own};
  if (!plan.has_spans) return span;
  const int x = static_cast<int>(surface % size(f.width));
  const int row = static_cast<int>(surface / size(f.width));
  const int y = row / f.layers, layer = row % f.layers;
  for (const auto& way : {std::array{-1, 0}, {1, 0}, {0, -1}, {0, 1}}) {
    // Radius so many pixels on, the fragment's own there or infinite.
    const auto radius = [&](int n) {
      const int px = x + n * way[0], py = y + n * way[1];
      if (px < 0 || px >= f.width || py < 0 || py >= f.height) return HUGE_VAL;
      const std::size_t at = f.index(px, py, layer);
      return is_fragment(f.depth[at]) ? static_cast<double>(f.coc_quanta[at]) : HUGE_VAL;
    };
    const double step = radius(1) - own;
    if (!goes_on(own - radius(-1), step, radius(2) - radius(1))) continue;
    const std::int32_t half_way = own + static_cast<std::int32_t>(std::floor(step / 2));
    span = {std::min(span.least, half_way), std::max(span.largest, half_way)};
  }
  return span;
}

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

namespace {

/// What shows through where no ray arrives: the farthest fragment behind a pixel and those around
/// it, two columns and one row to each side, by the least of its span. -1: none.
std::int64_t farthest_behind(const Frame& f, const RayPlan& plan, std::size_t pixel) {
  if (f.layers < 2 || f.coverage.empty()) return -1;
  const int x0 = static_cast<int>(pixel % static_cast<std::size_t>(f.width));
  const int y0 = static_cast<int>(pixel / static_cast<std::size_t>(f.width));
  std::int64_t found = -1;
  std::int32_t farthest = 0;
  for (int y = std::max(y0 - 1, 0); y <= std::min(y0 + 1, f.height - 1); ++y) {
    for (int x = std::max(x0 - 2, 0); x <= std::min(x0 + 2, f.width - 1); ++x) {
      const std::size_t i = f.index(x, y, 1);
      if (!is_fragment(f.depth[i]) || (f.coverage[i] & ~DEFRAY_SYNTHESISED) == 0) continue;
      const std::int32_t radius = span_of(f, plan, i).least;
      if (found >= 0 && radius <= farthest) continue;
      found = static_cast<std::int64_t>(i);
      farthest = radius;
    }
  }
  return found;
}

/// Calls visit(target, source, arrived) for every cell that shows a source, cell by cell in lens
/// order, and begin() before each cell.
template <typename Begin, typename Visit>
void for_each_winner(const Frame& f, const RayPlan& plan, const Begin& begin, const Visit& visit,
                     const Progress& progress) {
  const std::size_t count = plan.lens.points.size();
  for (std::size_t cell = 0; cell < count; ++cell) {
    const auto winner = rdb_scatter(f, plan, cell);
    begin();
    for (std::size_t i = 0; i < winner.size(); ++i) {
      const std::int64_t shown = winner[i] >= 0 ? winner[i] : farthest_behind(f, plan, i);
      if (shown >= 0) visit(i, static_cast<std::size_t>(shown), winner[i] >= 0);
    }
    if (progress) progress(static_cast<double>(cell + 1) / static_cast<double>(count));
  }
}

/// Whether the lens's rim keeps a cell's light from a pixel.
bool is_cut_off(const RayPlan& plan, int width, std::size_t pixel,
                const std::array<std::int32_t, 2>& u) {
  if (plan.rim_x.empty()) return false;
  const auto columns = static_cast<std::size_t>(width);
  return !passes_rim({plan.rim_x[pixel % columns], plan.rim_y[pixel / columns]}, u[0], u[1]);
}

/// The nearer of two fragments, of equal radii the first; -1: none yet.
void keep_nearer(const Frame& f, std::int64_t source, std::int64_t& held) {
  const auto coc = [&](std::int64_t i) { return f.coc_quanta[static_cast<std::size_t>(i)]; };
  const bool is_nearer =
      held < 0 || coc(source) < coc(held) || (coc(source) == coc(held) && source < held);
  if (is_nearer) held = source;
}

}  // namespace

RayResult TwinBackend::rays(const Frame& f, const RayPlan& plan, const LightSources* lights,
                            const Progress& progress) {
  const std::size_t pixels = f.pixels(), channels = f.channels.size();
  std::vector<Plane> sum(channels, Plane(pixels));
  std::vector<bool> differs(pixels);  // any colour from the pixel's own
  std::vector<std::size_t> filled(pixels);
  RayResult out{sum, std::vector<std::uint32_t>(pixels)};
  const bool has_light = lights && !lights->empty();
  std::vector<std::vector<std::int32_t>> winner;  // of every cell, for the light sources
  std::vector<std::int64_t> nearest(plan.wants_nearest ? pixels : 0, -1);
  std::size_t cell = 0;  // counts from 1 while its winners come
  const auto begin = [&] {
    ++cell;
    if (has_light) winner.emplace_back(pixels, -1);
  };
  const auto add = [&](std::size_t target, std::size_t source, bool arrived) {
    if (has_light && arrived) winner.back()[target] = static_cast<std::int32_t>(source);
    if (is_cut_off(plan, f.width, target, plan.lens.points[cell - 1])) return;
    ++filled[target];
    if (f.coverage.empty() || f.coverage[source] < DEFRAY_SYNTHESISED) ++out.seen[target];
    if (plan.wants_nearest && arrived && f.data_pixel(source) != DEFRAY_EMPTY) {
      keep_nearer(f, static_cast<std::int64_t>(source), nearest[target]);
    }
    for (std::size_t c = 0; c < channels; ++c) {
      sum[c][target] += f.channels[c][source];
      const float own = f.channels[c][f.front_of(target)];
      if (std::memcmp(&f.channels[c][source], &own, sizeof own) != 0) differs[target] = true;
    }
  };
  for_each_winner(f, plan, begin, add, progress);
  for (std::size_t c = 0; c < channels; ++c) {
    for (std::size_t i = 0; i < pixels; ++i) {
      out.means[c][i] =
          differs[i] ? sum[c][i] / static_cast<float>(filled[i]) : f.channels[c][f.front_of(i)];
    }
  }
  if (has_light) highlights_add(*lights, f, plan, winner, out.means);
  for (const std::int64_t n : nearest) {
    out.nearest.push_back(n < 0 ? DEFRAY_EMPTY : f.data_pixel(static_cast<std::size_t>(n)));
  }
  return out;
}

std::vector<std::vector<double>> exact_rays(const Frame& f, const RayPlan& plan) {
  std::vector<std::vector<double>> mean(f.channels.size(), std::vector<double>(f.pixels()));
  std::vector<int> filled(f.pixels());
  std::size_t cell = 0;
  const auto add = [&](std::size_t target, std::size_t source, bool) {
    if (is_cut_off(plan, f.width, target, plan.lens.points[cell - 1])) return;
    ++filled[target];
    for (std::size_t c = 0; c < mean.size(); ++c) {
      mean[c][target] += static_cast<double>(f.channels[c][source]);
    }
  };
  for_each_winner(f, plan, [&] { ++cell; }, add, {});
  for (std::size_t c = 0; c < mean.size(); ++c) {
    for (std::size_t i = 0; i < filled.size(); ++i) {
      mean[c][i] = filled[i] == 0 ? static_cast<double>(f.channels[c][f.front_of(i)])
                                  : mean[c][i] / filled[i];
    }
  }
  return mean;
}

}  // namespace defray::reference
