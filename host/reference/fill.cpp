// Twin of kernels/chain/fill.cl.
#include "reference/fill_found.h"

namespace defray::reference {
namespace {

float upper_median(std::vector<float> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Whether a CoC radius may be of the surface of another.
bool is_of(float coc, float surface, float own) {
  return std::fabs(coc - surface) <= DEFRAY_JUMP_QUANTA + 0.125f * (surface - own);
}

Found nearest_of(const std::vector<Found>& all) {
  return *std::min_element(all.begin(), all.end(),
                           [](auto& a, auto& b) { return a.distance < b.distance; });
}

/// The one on whose surface most of what was found lies, the nearest of them: directions count by
/// 1 / distance.
Found most_of(const std::vector<Found>& all, float own) {
  const Found* best = nullptr;
  float most = 0;
  for (const Found& f : all) {
    float around = 0;
    for (const Found& other : all) {
      if (is_of(other.coc, f.coc, own) || is_of(other.met, f.met, own))
        around += 1 / other.distance;
    }
    const bool is_nearer = best && around == most && f.distance < best->distance;
    if (best && around <= most && !is_nearer) continue;
    best = &f;
    most = around;
  }
  return *best;
}

/// How much more what was found counts where it follows a line or an edge, most of all where that
/// comes out again in the opposite direction.
float structure_of(const Found& f, const std::vector<Found>& all, const Planes& channels,
                   int directions) {
  float goes_on = 0;
  for (const Found& other : all) {
    if (std::abs(other.direction - f.direction) * 2 != directions) continue;
    const float sides = std::fmin(f.sides, other.sides);
    const float apart =
        squared_distance(colour_at(channels, f.source), colour_at(channels, other.source));
    if (apart < sides) goes_on = 10 * std::fmin(f.coherence, other.coherence) * (1 - apart / sides);
  }
  return 1 + 0.3f * f.coherence + goes_on;
}

/// Weighted mean of what lies on one surface.
struct Mean {
  float coc, inverse;
  Colour colour;
};

Mean mean_of(std::vector<Found> all, const Planes& channels, float own, int directions) {
  const bool is_all_around = 4 * all.size() >= 3 * size(directions);
  if (std::any_of(all.begin(), all.end(), [](auto& f) { return !f.is_barred; })) {
    std::erase_if(all, [](auto& f) { return f.is_barred; });
  }
  const float surface = (is_all_around ? most_of(all, own) : nearest_of(all)).coc;
  std::erase_if(all, [&](const Found& f) { return !is_of(f.coc, surface, own); });
  std::vector<float> bright;
  for (const Found& f : all) bright.push_back(brightness(colour_at(channels, f.source)));
  const float median = upper_median(bright);
  float weights = 0, coc = 0, inverse = 0, colour_weights = 0;
  Colour colour{};
  for (std::size_t i = 0; i < all.size(); ++i) {
    const float weight = 1 / (all[i].distance * all[i].distance);
    weights += weight;
    coc += weight * all[i].coc;
    inverse += weight * all[i].inverse;
    if (bright[i] > 10 * median) continue;
    const float shown = all[i].weight * structure_of(all[i], all, channels, directions);
    colour_weights += shown;
    add(colour, shown, colour_at(channels, all[i].source));
  }
  return Mean{coc / weights, inverse / weights, divided(colour, colour_weights)};
}

}  // namespace

Frame TwinBackend::fill(const Frame& f, const Words& marks, int directions, Frame) {
  std::vector<std::int32_t> coc = copy_of(f.coc_quanta);
  Plane inverse(f.pixels(), -1);
  std::vector<Plane> channels(f.channels.size(), Plane(f.pixels()));
  const Filler filler(f, marks, directions);
  const CocFrame frame(f);
  frame.for_each_place([&](Place at) {
    const auto [own, own_inverse] = filler.in_front(at);
    const std::vector<Found> all = filler.look_behind(at, own);
    if (all.empty()) return;
    const Mean mean = mean_of(all, f.channels, static_cast<float>(own), directions);
    const std::size_t pixel = frame.index(at);
    coc[pixel] = static_cast<std::int32_t>(std::nearbyint(mean.coc));
    inverse[pixel] = std::min(own_inverse * 0.99999f, mean.inverse);  // behind
    set_colour(channels, pixel, mean.colour);
  });
  Frame out = f.without_planes();
  out.coc_quanta = std::move(coc);
  out.inverse = std::move(inverse);
  out.channels = channels;
  return out;
}

}  // namespace defray::reference
