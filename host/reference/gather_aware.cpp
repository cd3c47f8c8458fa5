// Twin of kernels/methods/gather_aware.cl: a pixel's samples in two layers, what is nearer and the
// rest.
#include <cmath>
#include <numbers>

#include "reference/gather_samples.h"
#include "reference/reference.h"

namespace defray::reference {
namespace {

float disc_area(float radius) {
  constexpr float pi = std::numbers::pi_v<float>;
  return std::max(pi * (radius * radius + 1.0f / 12), 1.0f);
}

/// Pixels, or parts of one, that one of so many samples over a disc stands for.
float pixels_a_sample(float radius, std::size_t count) {
  return disc_area(radius) / static_cast<float>(std::max<std::size_t>(count, 1));
}

/// One layer of a pixel's samples: how far they spread, and what each stands for.
struct SampledDisc {
  float radius = 0, area = 1;
  std::vector<std::array<float, 2>> points;
};

/// The nearer surfaces' samples and the base's: the same points where the discs are alike, else
/// every second antipodal pair each. An odd set's centre counts as the first pair.
std::array<SampledDisc, 2> split_samples(float search, float own_radius,
                                         const std::vector<std::array<float, 2>>& samples) {
  const bool splits = search * search > 2 * own_radius * own_radius;
  SampledDisc near{search, 1, samples}, base{search, 1, samples};
  if (splits) {
    near.points.clear();
    base = {own_radius, 1, {}};
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const std::size_t pair = (i + samples.size() % 2) / 2;
      (pair % 2 == 1 ? base : near).points.push_back(samples[i]);
    }
  }
  for (SampledDisc* layer : {&near, &base}) {
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
std::vector<WeighedSource> weigh(const Frame& frame, std::span<const std::int32_t> coc,
                                 float quantum, int x, int y, const SampledDisc& layer,
                                 const Weight& weight) {
  std::vector<WeighedSource> sources;
  const float own = static_cast<float>(coc[frame.index(x, y)]) * quantum;
  for (const auto& [u, v] : layer.points) {
    const float dx = std::nearbyint(layer.radius * u), dy = std::nearbyint(layer.radius * v);
    const std::size_t source =
        frame.index_within(x + static_cast<int>(dx), y + static_cast<int>(dy));
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

void aware_pixel(const Frame& frame, const std::vector<Plane>& channels,
                 std::span<const std::int32_t> coc, float quantum, int x, int y, float search,
                 const std::vector<std::array<float, 2>>& samples, std::vector<Plane>& out) {
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
  const float base_weight = sum_of_weights(base, 1 / std::max(base_layer.area, 1.0f));
  const float rest = std::max(1.0f - near_weight, 0.0f);
  for (std::size_t c = 0; c < out.size(); ++c) {
    const Plane& plane = channels[c];
    const float near_mean = sum_of(plane, at, near) / std::max(near_weight, 1.0f);
    out[c][at] = plane[at] + (near_mean + rest * (sum_of(plane, at, base) / base_weight));
  }
}

}  // namespace

std::vector<Plane> gather_aware(const DefrayGatherParams& p, const GatherSamples& samples,
                                const std::vector<Plane>& channels, const Frame& f) {
  const auto coc_quanta = f.coc_quanta.host();
  const float quantum = std::ldexp(1.0f, -DEFRAY_COC_FRACTION_BITS) * p.radius_scale;
  const auto reach = gather_reach(f);
  const int across = (f.width + DEFRAY_GATHER_TILE - 1) / DEFRAY_GATHER_TILE;
  std::vector<Plane> out(channels);
  for (int y = 0; y < f.height; ++y) {
    for (int x = 0; x < f.width; ++x) {
      const int tile = y / DEFRAY_GATHER_TILE * across + x / DEFRAY_GATHER_TILE;
      const float search = static_cast<float>(reach[static_cast<std::size_t>(tile)]) * quantum;
      if (search < 0.5f) continue;
      const auto turned = samples_of_pixel(p, samples, x, y);
      aware_pixel(f, channels, coc_quanta, quantum, x, y, search, turned, out);
    }
  }
  return out;
}

}  // namespace defray::reference
