// Twins of kernels/rdb/rdb_merge.cl (Shinya 1994, section 4, step 5), of rdb_gather.cl, which gives
// the same, and of rdb_nearest.cl, from the same winners.
#include <algorithm>
#include <array>
#include <cstring>

#include "lens/cats_eye.h"
#include "rdb/sparse_tiles.h"
#include "reference/reference.h"
#include "reference/twin_backend.h"

namespace defray::reference {
namespace {

/// What shows through where no ray arrives: the farthest fragment of a pixel and those around it,
/// two columns and one row to each side, by the least of its span, where anything lies behind any
/// of them. -1: nothing does.
std::int64_t farthest_behind(const Frame& f, const RayPlan& plan, std::size_t pixel) {
  if (f.layers < 2 || f.coverage.empty()) return -1;
  const int x0 = static_cast<int>(pixel % static_cast<std::size_t>(f.width));
  const int y0 = static_cast<int>(pixel / static_cast<std::size_t>(f.width));
  std::int64_t found = -1;
  std::int32_t farthest = 0;
  const auto look_at = [&](int layer) {
    for (int y = std::max(y0 - 1, 0); y <= std::min(y0 + 1, f.height - 1); ++y) {
      for (int x = std::max(x0 - 2, 0); x <= std::min(x0 + 2, f.width - 1); ++x) {
        const std::size_t i = f.index(x, y, layer);
        if (!is_fragment(f.depth[i]) || (f.coverage[i] & ~DEFRAY_SYNTHESISED) == 0) continue;
        const std::int32_t radius = span_of(f, plan, i).least;
        if (found >= 0 && radius <= farthest) continue;
        found = static_cast<std::int64_t>(i);
        farthest = radius;
      }
    }
  };
  look_at(1);
  if (found >= 0) look_at(0);
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
  std::vector<std::int64_t> nearest(plan.wants_nearest ? pixels : 0, -1);
  std::size_t cell = 0;  // counts from 1 while its rays come
  const auto begin = [&] { ++cell; };
  const auto add = [&](std::size_t target, std::size_t source, bool arrived) {
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
  if (plan.sparse_from[0] > 0) {
    const TileWindow all{0, ray_tiles_along(f.width), ray_tiles_along(f.height)};
    rdb_between(f, sparse_tiles(ray_tiles(f, plan).least, all, f, plan), out);
  }
  if (lights && !lights->empty()) highlights_add(*lights, f, plan, out.means);
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
