// Twins of kernels/gather_literal.cl, gather_aware.cl and gather_reach.cl: Glatzel & Wilhelm, eq.
// 4, and the same with each sample weighed by whether its light arrives.
#include "gather.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "reference/pcg3d.h"
#include "reference/reference.h"

namespace defray::reference {
namespace {

/// A frame that repeats its edge pixels.
struct Frame {
  int width, height;
  const std::vector<Plane>& channels;

  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(std::clamp(y, 0, height - 1)) *
               static_cast<std::size_t>(width) +
           static_cast<std::size_t>(std::clamp(x, 0, width - 1));
  }
  float bilinear(std::size_t c, int x, int y, float part_x, float part_y) const {
    const Plane& plane = channels[c];
    const auto between = [](float a, float b, float part) { return a + (b - a) * part; };
    const float upper = between(plane[index(x, y)], plane[index(x + 1, y)], part_x);
    const float lower = between(plane[index(x, y + 1)], plane[index(x + 1, y + 1)], part_x);
    return between(upper, lower, part_y);
  }
};

/// A pixel's samples, turned.
std::vector<std::array<float, 2>> samples_of_pixel(const DefrayGatherParams& p,
                                                   const GatherSamples& samples, int x, int y) {
  if (!p.rotates) return samples.points;
  const auto hash = pcg3d(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), p.seed);
  const auto [c, s] = samples.turns[hash[0] % samples.turns.size()];
  std::vector<std::array<float, 2>> turned;
  for (const auto& [u, v] : samples.points) turned.push_back({u * c - v * s, u * s + v * c});
  return turned;
}

float literal_pixel(const Frame& frame, std::size_t c, int x, int y, float radius,
                    const std::vector<std::array<float, 2>>& samples) {
  const float own = frame.channels[c][frame.index(x, y)];
  if (radius == 0) return own;
  float sum = 0;
  for (const auto& [u, v] : samples) {
    const float dx = radius * u, dy = radius * v;
    const float fx = std::floor(dx), fy = std::floor(dy);
    sum += frame.bilinear(c, x + static_cast<int>(fx), y + static_cast<int>(fy), dx - fx, dy - fy) -
           own;
  }
  return own + sum / static_cast<float>(samples.size());
}

float disc_area(float radius) {
  constexpr float pi = std::numbers::pi_v<float>;
  return std::max(pi * (radius * radius + 1.0f / 12), 1.0f);
}

/// Pixels that one of so many samples over a disc stands for, at least one.
float pixels_a_sample(float radius, std::size_t count) {
  return std::max(disc_area(radius) / static_cast<float>(std::max<std::size_t>(count, 1)), 1.0f);
}

/// One layer of a pixel's samples: how far they spread, and what each stands for.
struct Layer {
  float radius = 0, area = 1;
  std::vector<std::array<float, 2>> points;
};

/// The nearer surfaces' samples and the base's: the same points where the discs are alike, else
/// every second antipodal pair each. An odd set's centre counts as the first pair.
std::array<Layer, 2> split_samples(float search, float own_radius,
                                   const std::vector<std::array<float, 2>>& samples) {
  const bool splits = search * search > 2 * own_radius * own_radius;
  Layer near{search, 1, samples}, base{search, 1, samples};
  if (splits) {
    near.points.clear();
    base = {own_radius, 1, {}};
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const std::size_t pair = (i + samples.size() % 2) / 2;
      (pair % 2 == 1 ? base : near).points.push_back(samples[i]);
    }
  }
  for (Layer* layer : {&near, &base}) {
    layer->area = pixels_a_sample(layer->radius, layer->points.size());
  }
  return {near, base};
}

struct WeighedSource {
  std::size_t source;
  float weight;
};

/// Sources of a layer with their weights, those without weight left out.
/// weight(own CoC, their CoC, distance).
template <typename Weight>
std::vector<WeighedSource> weigh(const Frame& frame, const std::vector<std::int32_t>& coc,
                                 float quantum, int x, int y, const Layer& layer,
                                 const Weight& weight) {
  std::vector<WeighedSource> sources;
  const float own = static_cast<float>(coc[frame.index(x, y)]) * quantum;
  for (const auto& [u, v] : layer.points) {
    const float dx = std::nearbyint(layer.radius * u), dy = std::nearbyint(layer.radius * v);
    const std::size_t source = frame.index(x + static_cast<int>(dx), y + static_cast<int>(dy));
    const float theirs = static_cast<float>(coc[source]) * quantum;
    const float share = weight(own, theirs, std::sqrt(dx * dx + dy * dy));
    if (share > 0) sources.push_back({source, share});
  }
  return sources;
}

float sum_of_weights(const std::vector<WeighedSource>& sources, float start) {
  for (const WeighedSource& s : sources) start += s.weight;
  return start;
}

/// Weighted sum of differences to the pixel's own colour.
float sum_of(const Plane& plane, std::size_t own, const std::vector<WeighedSource>& sources) {
  float sum = 0;
  for (const WeighedSource& s : sources) sum += s.weight * (plane[s.source] - plane[own]);
  return sum;
}

float nearness(float own, float theirs) { return std::clamp(own - theirs - 0.5f, 0.0f, 1.0f); }

float covers(float coc, float distance) {
  return std::clamp(std::fabs(coc) + 0.5f - distance, 0.0f, 1.0f);
}

void aware_pixel(const Frame& frame, const std::vector<std::int32_t>& coc, float quantum, int x,
                 int y, float search, const std::vector<std::array<float, 2>>& samples,
                 std::vector<Plane>& out) {
  const std::size_t at = frame.index(x, y);
  const float own_radius = std::fabs(static_cast<float>(coc[at]) * quantum);
  const auto [near_layer, base_layer] = split_samples(search, own_radius, samples);
  const float near_area = near_layer.area;
  const auto near =
      weigh(frame, coc, quantum, x, y, near_layer, [=](float own, float theirs, float distance) {
        return nearness(own, theirs) * covers(theirs, distance) * near_area /
               disc_area(std::fabs(theirs));
      });
  const auto base =
      weigh(frame, coc, quantum, x, y, base_layer, [](float own, float theirs, float distance) {
        return (1.0f - nearness(own, theirs)) * covers(own, distance);
      });
  const float near_weight = sum_of_weights(near, 0);
  const float base_weight = sum_of_weights(base, 1 / base_layer.area);
  const float rest = std::max(1.0f - near_weight, 0.0f);
  for (std::size_t c = 0; c < out.size(); ++c) {
    const Plane& plane = frame.channels[c];
    const float near_mean = sum_of(plane, at, near) / std::max(near_weight, 1.0f);
    out[c][at] = plane[at] + (near_mean + rest * (sum_of(plane, at, base) / base_weight));
  }
}

}  // namespace

std::vector<std::int32_t> gather_reach(int width, int height,
                                       const std::vector<std::int32_t>& coc_quanta) {
  constexpr int tile = DEFRAY_GATHER_TILE;
  const int across = (width + tile - 1) / tile, down = (height + tile - 1) / tile;
  const auto as_size = [](int i) { return static_cast<std::size_t>(i); };
  std::vector<std::int32_t> largest(as_size(across) * as_size(down)), reach(largest.size());
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      std::int32_t& most = largest[as_size(y / tile) * as_size(across) + as_size(x / tile)];
      most = std::max(most, std::abs(coc_quanta[as_size(y) * as_size(width) + as_size(x)]));
    }
  }
  for (int i = 0; i < across * down; ++i) {
    for (int j = 0; j < across * down; ++j) {
      const int steps =
          std::max(std::abs(i % across - j % across), std::abs(i / across - j / across));
      const double gap_px = std::max(steps - 1, 0) * tile;
      if (gap_px <= largest[as_size(j)] / 256.0) {
        reach[as_size(i)] = std::max(reach[as_size(i)], largest[as_size(j)]);
      }
    }
  }
  return reach;
}

std::vector<Plane> gather(const DefrayGatherParams& p, GatherKind kind,
                          const GatherSamples& samples, const std::vector<std::int32_t>& coc_quanta,
                          const std::vector<Plane>& channels) {
  const Frame frame{static_cast<int>(p.width), static_cast<int>(p.height), channels};
  const float quantum = std::ldexp(1.0f, -DEFRAY_COC_FRACTION_BITS) * p.radius_scale;
  const auto reach = kind == GatherKind::aware ? gather_reach(frame.width, frame.height, coc_quanta)
                                               : std::vector<std::int32_t>{};
  const int across = (frame.width + DEFRAY_GATHER_TILE - 1) / DEFRAY_GATHER_TILE;
  std::vector<Plane> out(channels);
  for (int y = 0; y < frame.height; ++y) {
    for (int x = 0; x < frame.width; ++x) {
      const auto turned = samples_of_pixel(p, samples, x, y);
      const std::size_t at = frame.index(x, y);
      if (kind == GatherKind::literal) {
        const float radius = std::fabs(static_cast<float>(coc_quanta[at])) * quantum;
        for (std::size_t c = 0; c < out.size(); ++c) {
          out[c][at] = literal_pixel(frame, c, x, y, radius, turned);
        }
        continue;
      }
      const int tile = y / DEFRAY_GATHER_TILE * across + x / DEFRAY_GATHER_TILE;
      const float search = static_cast<float>(reach[static_cast<std::size_t>(tile)]) * quantum;
      if (search >= 0.5f) aware_pixel(frame, coc_quanta, quantum, x, y, search, turned, out);
    }
  }
  return out;
}

std::vector<Plane> render_gather(int width, int height, const std::vector<std::int32_t>& coc_quanta,
                                 const std::vector<Plane>& channels,
                                 const GatherSettings& settings) {
  validate(settings);
  const GatherSamples samples = make_gather_samples(settings);
  std::vector<Plane> result = channels;
  for (int pass = 0; pass < settings.passes; ++pass) {
    result = gather(gather_params(settings, width, height, pass), settings.kind, samples,
                    coc_quanta, result);
  }
  return result;
}

}  // namespace defray::reference
