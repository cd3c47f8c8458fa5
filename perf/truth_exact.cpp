#include "truth_exact.h"

#include <algorithm>
#include <cmath>

#include "frame/stages.h"
#include "rdb/rdb.h"

namespace defray::perf {
namespace {

/// One layer of fragments, [height][width].
struct Layer {
  std::vector<std::int32_t> coc_quanta;
  Plane depth;  ///< `no_fragment()` where there is none.
  std::vector<Plane> colour;
  std::vector<std::uint32_t> coverage;
};

/// The same view, so many pixels more on each side.
Scene widened(const Scene& scene, int margin) {
  Scene wide = make_scene(scene.name, scene.width, scene.height);
  wide.width += 2 * margin;
  wide.height += 2 * margin;
  wide.sensor_width_mm *= static_cast<double>(wide.width) / scene.width;
  return wide;
}

/// A picture's surfaces as fragments. What is nothing is no fragment, but for a background.
Layer layer_of(const Bench& bench, const Subject& s, const ScenePicture& picture) {
  Layer layer{{}, picture.depth, picture.colour, {}};
  for (float& z : layer.depth) {
    if (z >= static_cast<float>(nothing_there)) z = HUGE_VALF;
  }
  layer.coc_quanta = coc_on_device(bench.session, s.lens, s.scene.width, layer.depth);
  layer.coverage.assign(layer.depth.size(), DEFRAY_WHOLE);
  for (std::size_t i = 0; i < layer.depth.size(); ++i) {
    if (!std::isinf(layer.depth[i]) || s.scene.background) continue;
    layer.depth[i] = no_fragment();
    layer.coverage[i] = 0;
  }
  return layer;
}

Plane inverse_of(const Plane& depth) {
  Plane inverse;
  for (const float z : depth) inverse.push_back(is_fragment(z) ? 1 / z : -1.0f);
  return inverse;
}

/// What lies behind, where something uncovers it.
Layer behind_of(const Bench& bench, const Wide& w) {
  Layer behind = layer_of(bench, w.subject, w.exact.behind);
  for (std::size_t i = 0; i < behind.depth.size(); ++i) {
    if (w.is_uncovered[i] || w.exact.share[i] < 1) continue;
    behind.depth[i] = no_fragment();
    behind.coverage[i] = 0;
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

Frame fragments_of(const Wide& w, const Layer& front, const Layer& behind) {
  Frame f{w.subject.scene.width, w.subject.scene.height, 2, {}, {}, {}, {}};
  f.channels.resize(3);
  const auto append = [&](auto& to, const auto& from, std::size_t row) {
    const auto begin = from.begin() + static_cast<std::ptrdiff_t>(row * size(f.width));
    to.insert(to.end(), begin, begin + f.width);
  };
  for (std::size_t row = 0; row < size(f.height); ++row) {
    for (const Layer* layer : {&front, &behind}) {
      append(f.coc_quanta, layer->coc_quanta, row);
      append(f.depth, layer->depth, row);
      append(f.coverage, layer->coverage, row);
      for (std::size_t c = 0; c < 3; ++c) append(f.channels[c], layer->colour[c], row);
    }
  }
  return f;
}

Layer layer_of(Surface s) {
  Layer layer{std::move(s.coc_quanta), {}, std::move(s.channels), std::move(s.coverage)};
  for (std::size_t i = 0; i < s.inverse.size(); ++i) {
    const float inverse = s.inverse[i];
    layer.depth.push_back(inverse < 0 ? no_fragment() : 1 / inverse);  // 1/0: the background
    if (inverse < 0) layer.coverage[i] = 0;
  }
  return layer;
}

}  // namespace

Wide make_wide(const Bench& bench, const Setup& setup) {
  const Scene& scene = setup.subject.scene;
  const int margin = std::min(rdb_reach(largest_coc(setup.subject.coc)), scene.height);
  Wide w{setup, margin, make_antialiased(bench.stages, widened(scene, margin), setup.setting),
         {},    {},     {}};
  const Subject& s = w.subject;
  w.exact = render_coverage(s.scene, pinhole_samples);
  w.mixed = edges(bench.session, s.scene.width, s.scene.height, s.coc);
  const Plane inverse = inverse_of(s.pinhole.depth);
  const FrameView view{s.scene.width, s.scene.height, s.coc, inverse, s.pinhole.colour};
  for (const float i : fill(bench.session, view, w.mixed).inverse) w.is_uncovered.push_back(i >= 0);
  return w;
}

Frame exact_fragments(const Bench& bench, const Wide& w) {
  Layer front = layer_of(bench, w.subject, w.exact.front);
  for (std::size_t i = 0; i < front.coverage.size(); ++i) {
    const double share = static_cast<double>(w.exact.share[i]);
    if (front.coverage[i] > 0) {
      front.coverage[i] = static_cast<std::uint32_t>(std::lround(share * DEFRAY_WHOLE));
    }
  }
  return fragments_of(w, front, behind_of(bench, w));
}

Frame split_fragments(const Bench& bench, const Wide& w) {
  const Subject& s = w.subject;
  const Plane inverse = inverse_of(s.pinhole.depth);
  const FrameView view{s.scene.width, s.scene.height, s.coc, inverse, s.pinhole.colour};
  Layer behind = behind_of(bench, w);
  const Layer own = layer_of(bench, s, w.exact.front);
  for (std::size_t i = 0; i < w.mixed.size(); ++i) {
    const int x = static_cast<int>(i) % view.width, y = static_cast<int>(i) / view.width;
    if (!w.mixed[i] || w.exact.share[i] < 1 || !saw_farther(s, x, y)) continue;
    behind.coc_quanta[i] = own.coc_quanta[i];  // the farther surface is the pixel's own
    behind.depth[i] = own.depth[i];
    for (std::size_t c = 0; c < 3; ++c) behind.colour[c][i] = own.colour[c][i];
  }
  Surfaces parts = split(bench.session, view, w.mixed,
                         {behind.coc_quanta, inverse_of(behind.depth), behind.colour, {}});
  return fragments_of(w, layer_of(std::move(parts.front)), layer_of(std::move(parts.behind)));
}

}  // namespace defray::perf
