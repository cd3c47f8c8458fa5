#include "splat/splat_picture.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>

#include "base/parallel.h"
#include "base/stopwatch.h"
#include "base/vec3.h"
#include "splat/cut.h"
#include "splat/seen_sides.h"
#include "splat/view.h"

namespace defray {
namespace {

void describe(const Values<DefraySplat>& splats, const DefraySplatParams& p, SplatReport& report) {
  report.seen = splats.size();
  if (splats.empty()) return;
  float nearest = std::numeric_limits<float>::infinity(), farthest = 0;
  std::mutex mutex;
  parallel_for_stretches(
      splats.size(),
      [&](std::size_t first, std::size_t end) {
        const auto [least, most] = std::minmax_element(
            splats.begin() + first, splats.begin() + end,
            [](const DefraySplat& a, const DefraySplat& b) { return a.z < b.z; });
        const std::scoped_lock lock(mutex);
        nearest = std::min(nearest, least->z);
        farthest = std::max(farthest, most->z);
      },
      short_stretch);
  report.nearest_units = nearest;
  report.farthest_units = farthest;
  const double zero = 0;  // added, it leaves no -0
  report.nearest_coc_px = zero + splat_coc_px(p, report.nearest_units);
  report.farthest_coc_px = zero + splat_coc_px(p, report.farthest_units);
}

/// How many fragments pixels have, and how many of those lack surfaces (then below 0).
struct FragmentCounts {
  double fragments = 0;
  std::size_t spilled = 0;

  FragmentCounts& operator+=(const FragmentCounts& other) {
    fragments += other.fragments;
    spilled += other.spilled;
    return *this;
  }
};

/// Leaves the numbers without their signs.
void count_fragments(Plane& counts, SplatReport& report) {
  const auto all = parallel_sum(counts.size(), [&](std::size_t first, std::size_t end) {
    FragmentCounts sum;
    for (std::size_t i = first; i < end; ++i) {
      sum.spilled += counts[i] < 0;
      counts[i] = std::fabs(counts[i]);
      sum.fragments += static_cast<double>(counts[i]);
    }
    return sum;
  });
  report.fragments += all.fragments;
  report.spilled += all.spilled;
}

void make_transparent(Values<DefraySplatNode>& nodes, double transparency) {
  if (transparency == 0) return;
  const auto kept = static_cast<float>(1 - transparency);
  for (DefraySplatNode& n : nodes.edit()) {
    for (float* value : {&n.r, &n.g, &n.b, &n.a}) *value *= kept;
  }
}

/// The sharp picture from a point of the lens, (u, v) in units of its radius.
DefraySplatParams view_from(DefraySplatParams p, double u, double v) {
  const double right = u * static_cast<double>(p.lens_units);
  const double down = v * static_cast<double>(p.lens_units);
  const auto moved = [&](float from, float along_right, float along_down) {
    return static_cast<float>(from + right * along_right + down * along_down);
  };
  p.eye_x = moved(p.eye_x, p.right_x, p.down_x);
  p.eye_y = moved(p.eye_y, p.right_y, p.down_y);
  p.eye_z = moved(p.eye_z, p.right_z, p.down_z);
  if (!p.focus_is_infinite) {
    p.centre_x += static_cast<float>(right * p.focal_px / p.focus_units);
    p.centre_y += static_cast<float>(down * p.focal_px / p.focus_units);
  }
  p.focus_is_infinite = 0;
  p.coc_scale_px = 0;
  return p;
}

/// Adds what is seen of surfaces that are in different places.
void add_nearest_first(const std::vector<SplatPlanes>& surfaces,
                       std::vector<std::vector<double>>& sums) {
  std::vector<const SplatPlanes*> order;
  for (const SplatPlanes& surface : surfaces) order.push_back(&surface);
  for (std::size_t k = 0; k < sums[0].size(); ++k) {
    std::sort(order.begin(), order.end(), [&](const SplatPlanes* a, const SplatPlanes* b) {
      return std::pair(a->depth[k], a) < std::pair(b->depth[k], b);
    });
    double left = 1;
    for (const SplatPlanes* surface : order) {
      for (std::size_t c = 0; c < 4; ++c) {
        sums[c][k] += left * static_cast<double>(surface->colour[c][k]);
      }
      left *= 1 - static_cast<double>(surface->colour[3][k]);
    }
  }
}

}  // namespace

SplatPlanes draw_splats(Backend& backend, const Hierarchy& tree, const DefraySplatParams& params,
                        bool lod, double transparency, SplatReport& report,
                        const Progress& progress) {
  Stopwatch watch;
  const auto done = [&](const char* stage) { report.stages.push_back({stage, watch.lap()}); };
  report.points = tree.points.size();
  report.both_sides =
      params.one_sided ? static_cast<double>(tree.nodes.front().splat.both_sides) : 1;
  Values<DefraySplatNode> nodes = cut_hierarchy(tree, params, lod);
  make_transparent(nodes, transparency);
  report.drawn = nodes.size();
  if (params.one_sided) describe_sides(nodes, params, report);
  done("cut");
  const auto ridges = Values<DefraySplatRidge>::view(tree.ridges.data(), tree.ridges.size());
  Splats splats = backend.splat_project(nodes, ridges, params);
  splats.all.host();  // once the kernel has made them
  done("project");
  splats = in_order(splats);
  describe(splats.all, params, report);
  done("order");
  SplatPlanes planes = backend.splat_resolve(splats, params, progress);
  count_fragments(planes.fragments, report);
  done("resolve");
  return planes;
}

std::vector<Plane> mean_of_views(Backend& backend, const std::vector<const Hierarchy*>& surfaces,
                                 const DefraySplatParams& params, int views,
                                 const Progress& progress) {
  std::vector<std::vector<double>> sums(
      4, std::vector<double>(size(static_cast<int>(params.width)) * params.height));
  const double golden = M_PI * (3 - std::sqrt(5.0));
  for (int i = 0; i < views; ++i) {
    const double radius = std::sqrt((i + 0.5) / views), angle = golden * i;
    const DefraySplatParams view =
        view_from(params, radius * std::cos(angle), radius * std::sin(angle));
    std::vector<SplatPlanes> drawn;
    for (const Hierarchy* surface : surfaces) {
      SplatReport ignored;
      drawn.push_back(draw_splats(backend, *surface, view, true, 0, ignored));
    }
    add_nearest_first(drawn, sums);
    if (progress) progress(static_cast<double>(i + 1) / views);
  }
  std::vector<Plane> mean;
  for (const std::vector<double>& sum : sums) {
    Plane& plane = mean.emplace_back();
    for (const double value : sum) plane.push_back(static_cast<float>(value / views));
  }
  return mean;
}

}  // namespace defray
