#include "chain/half_size.h"

#include <algorithm>

#include "base/parallel.h"
#include "base/stopwatch.h"
#include "chain/full_size.h"

namespace defray {
namespace {

/// Every pixel opaque.
bool is_opaque(const Frame& f) {
  const auto alpha = f.channels.back().host();
  return f.has_alpha &&
         parallel_count(alpha.size(), [&](std::size_t i) { return alpha[i] != 1.0f; }) == 0;
}

/// What the half frame's chain gives, and how much of each pixel's detail is to be seen.
struct HalfResult {
  MethodResult result;
  Plane visible;
};

/// `visible` goes through the lens as a channel: in the place of an alpha that is 1 everywhere,
/// beside three others, or else alone.
HalfResult through_lens(HalfFrame& half, bool is_opaque, const ChainSettings& settings,
                        Backend& backend, bool wants_nearest, const Progress& progress) {
  Frame& f = half.frame;
  Planes own = f.channels;
  if (is_opaque) f.channels.pop_back();
  const bool has_alpha = f.has_alpha && !is_opaque;
  const bool has_room = f.channels.size() < 4 && !has_alpha;
  f.has_alpha = has_alpha;
  if (has_room) f.channels.emplace_back(half.detail);
  HalfResult out{run_chain(f, settings, backend, wants_nearest, progress), {}};
  std::vector<Plane>& colour = out.result.colour;
  if (has_room) {
    out.visible = std::move(colour.back());
    colour.pop_back();
  } else {
    f.channels = {Values<float>(half.detail)};
    f.has_alpha = false;
    ChainSettings plain = settings;
    plain.highlights = false;
    out.visible = run_chain(f, plain, backend).colour[0];
  }
  if (is_opaque) colour.emplace_back(f.pixels(), 1.0f);
  f.channels = std::move(own);
  return out;
}

/// Pixels of the frame for those of the half frame; a block that has its own leaves each pixel its
/// own.
std::vector<std::uint32_t> nearest_at_full_size(const Frame& f, const HalfFrame& half,
                                                const std::vector<std::uint32_t>& nearest) {
  std::vector<std::uint32_t> out(f.pixels());
  for (std::size_t i = 0; i < out.size(); ++i) {
    const int x = static_cast<int>(i % size(f.width)), y = static_cast<int>(i / size(f.width));
    const std::size_t block = half.frame.index(x / 2, y / 2);
    out[i] = nearest[block] == block ? static_cast<std::uint32_t>(i) : half.source[nearest[block]];
  }
  return out;
}

}  // namespace

MethodResult run_half_size(const Frame& f, const ChainSettings& settings, Backend& backend,
                           bool wants_nearest, const Progress& progress) {
  Stopwatch watch;
  HalfFrame half = at_half_size(f);
  const bool opaque = is_opaque(f);
  const double halving = watch.lap();
  HalfResult made = through_lens(half, opaque, settings, backend, wants_nearest, progress);
  watch.lap();
  MethodResult& out = made.result;
  if (opaque) out.colour.pop_back();
  out.colour = with_detail(f, half, out.colour, made.visible);
  if (opaque) out.colour.emplace_back(f.pixels(), 1.0f);
  out.confidence = at_full_size(out.confidence, f.width, f.height);
  out.tiles.double_size(f.width, f.height);
  if (wants_nearest) out.nearest = nearest_at_full_size(f, half, out.nearest);
  out.report->stages.insert(out.report->stages.begin(), {"half size", halving, 0});
  out.report->stages.push_back({"full size", watch.lap(), 0});
  return std::move(made.result);
}

}  // namespace defray
