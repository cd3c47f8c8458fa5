#include "truth/truth_exact.h"

#include <algorithm>
#include <cmath>

#include "lens/coc.h"
#include "rdb/rdb_plan.h"

namespace defray::perf {
namespace {

/// The same view, so many pixels more on each side.
Scene widened(const Scene& scene, int margin) {
  Scene wide = make_scene(scene.name, scene.width, scene.height);
  wide.width += 2 * margin;
  wide.height += 2 * margin;
  wide.sensor_width_mm *= static_cast<double>(wide.width) / scene.width;
  return wide;
}

/// A picture's surfaces. What is nothing is no surface, but for a background.
Frame surfaces_of(const Bench& bench, const Subject& s, const ScenePicture& picture) {
  Plane depth = picture.depth;
  for (float& z : depth) {
    if (z >= static_cast<float>(nothing_there)) z = HUGE_VALF;
  }
  Frame f{s.scene.width,
          s.scene.height,
          bench.backend.coc(s.lens, s.scene.width, depth),
          {},
          picture.colour};
  std::vector<std::uint32_t> coverage(depth.size(), DEFRAY_WHOLE);
  for (std::size_t i = 0; i < depth.size(); ++i) {
    if (!std::isinf(depth[i]) || s.scene.background) continue;
    depth[i] = no_fragment();
    coverage[i] = 0;
  }
  f.depth = std::move(depth);
  f.coverage = std::move(coverage);
  return f;
}

Plane inverse_of(std::span<const float> depth) {
  Plane inverse;
  for (const float z : depth) inverse.push_back(is_fragment(z) ? 1 / z : -1.0f);
  return inverse;
}

/// The pinhole picture as the chain's first stages take it.
Frame with_inverse(const Subject& s) {
  Frame f = s.frame();
  f.inverse = inverse_of(s.pinhole.depth);
  return f;
}

/// What lies behind, where something uncovers it.
Frame behind_of(const Bench& bench, const Wide& w) {
  Frame behind = surfaces_of(bench, w.subject, w.exact.behind);
  const auto depth = behind.depth.edit();
  const auto coverage = behind.coverage.edit();
  for (std::size_t i = 0; i < depth.size(); ++i) {
    if (w.is_uncovered[i] || w.exact.share[i] < 1) continue;
    depth[i] = no_fragment();
    coverage[i] = 0;
  }
  return behind;
}

/// A pixel at a silhouette whose depth sample saw the farther surface, as `split` has it.
bool saw_farther(const Subject& s, int x, int y) {
  const auto coc = [&](int i, int j) {
    return s.coc[size(std::clamp(j, 0, s.scene.height - 1)) * size(s.scene.width) +
                 size(std::clamp(i, 0, s.scene.width - 1))];
  };
  std::int32_t least = coc(x, y), most = least;
  for (int n = 0; n < 9; ++n) {
    least = std::min(least, coc(x + n % 3 - 1, y + n / 3 - 1));
    most = std::max(most, coc(x + n % 3 - 1, y + n / 3 - 1));
  }
  return coc(x, y) >= least + (most - least) / 2;
}

/// Two planes, row by row.
template <typename T>
std::vector<T> interleaved(const Values<T>& front, const Values<T>& behind, int width) {
  std::vector<T> rows;
  for (std::size_t at = 0; at < front.size(); at += size(width)) {
    for (const Values<T>* plane : {&front, &behind}) {
      rows.insert(rows.end(), plane->begin() + at, plane->begin() + at + width);
    }
  }
  return rows;
}

/// As the layers of Backend::split, but depths keep their last bit: they need not go through
/// 1/depth.
Frame layered(const Frame& front, const Frame& behind) {
  Frame f = front.without_planes();
  f.layers = 2;
  const auto both = [&](const auto& a, const auto& b) { return interleaved(a, b, f.width); };
  f.coc_quanta = both(front.coc_quanta, behind.coc_quanta);
  f.depth = both(front.depth, behind.depth);
  f.coverage = both(front.coverage, behind.coverage);
  for (std::size_t c = 0; c < front.channels.size(); ++c) {
    f.channels.push_back(both(front.channels[c], behind.channels[c]));
  }
  return f;
}

}  // namespace

Wide make_wide(const Bench& bench, const Setup& setup) {
  const Scene& scene = setup.subject.scene;
  const int margin = std::min(rdb_reach(largest_coc(setup.subject.coc.host())), scene.height);
  Wide w{setup, margin, make_antialiased(bench.backend, widened(scene, margin), setup.setting),
         {},    {},     {}};
  w.exact = render_coverage(w.subject.scene, pinhole_samples);
  const Frame pinhole = with_inverse(w.subject);
  w.mixed = bench.backend.mixed(pinhole);
  const Frame behind = bench.backend.fill(pinhole, w.mixed, DEFRAY_FILL_DIRECTIONS);
  for (const float i : behind.inverse) w.is_uncovered.push_back(i >= 0);
  return w;
}

Frame exact_surfaces(const Bench& bench, const Wide& w) {
  Frame front = surfaces_of(bench, w.subject, w.exact.front);
  const auto coverage = front.coverage.edit();
  for (std::size_t i = 0; i < coverage.size(); ++i) {
    const double share = static_cast<double>(w.exact.share[i]);
    if (coverage[i] > 0)
      coverage[i] = static_cast<std::uint32_t>(std::lround(share * DEFRAY_WHOLE));
  }
  return layered(front, behind_of(bench, w));
}

Frame split_surfaces(const Bench& bench, const Wide& w) {
  const Subject& s = w.subject;
  Frame behind = behind_of(bench, w);
  const Frame own = surfaces_of(bench, s, w.exact.front);
  for (std::size_t i = 0; i < w.mixed.size(); ++i) {
    const int x = static_cast<int>(i) % s.scene.width, y = static_cast<int>(i) / s.scene.width;
    if (!w.mixed[i] || w.exact.share[i] < 1 || !saw_farther(s, x, y)) continue;
    behind.coc_quanta.edit()[i] = own.coc_quanta[i];  // the farther surface is the pixel's own
    behind.depth.edit()[i] = own.depth[i];
    for (std::size_t c = 0; c < 3; ++c) behind.channels[c].edit()[i] = own.channels[c][i];
  }
  behind.inverse = inverse_of(behind.depth.host());
  return bench.backend.split(with_inverse(s), w.mixed, behind);
}

}  // namespace defray::perf
