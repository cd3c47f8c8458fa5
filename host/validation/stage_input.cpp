#include "validation/stage_input.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/random.h"
#include "lens/aperture_mask.h"
#include "lens/landing_radii.h"
#include "methods/linear.h"
#include "methods/tiltshift.h"
#include "reference/twin_backend.h"

namespace defray::validation {
namespace {

/// Pixels anywhere: few, so that ways still pass over what they need not look at, many, or none.
template <typename Visit>
void for_each_sprinkled(const Case& c, std::uint32_t seed, const Visit& visit) {
  const double share = std::array{0.0, 1.0 / 512, 1.0 / 16}[seed % 3];
  for (std::size_t i = 0; i < size(c.width) * size(c.height); ++i) {
    const auto x = static_cast<int>(i) % c.width, y = static_cast<int>(i) / c.width;
    if (Random(x, y, seed).next() < share) visit(i);
  }
}

}  // namespace

Frame stage_frame(const Case& c, const Input& in) {
  std::vector<std::int32_t> coc_quanta;
  Plane inverse;
  const int width = c.width, height = c.height;
  const bool has_blocks =
      c.seed % 4 != 0 && (c.pattern == Pattern::random || c.pattern == Pattern::ties ||
                          c.pattern == Pattern::checker || c.pattern == Pattern::converging);
  const double slant = c.coc_px >= 1 ? c.seed % 3 : 0;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const bool is_thin = x % 23 == 11;
      const int from_x = has_blocks && !is_thin ? x / 9 * 9 : x;
      const int from_y = has_blocks ? y / 6 * 6 : y;
      const auto from = static_cast<std::size_t>(from_y) * static_cast<std::size_t>(width) +
                        static_cast<std::size_t>(from_x);
      const double coc = in.coc_quanta[from] + slant * (24 * x - 16 * y);
      const double limit = DEFRAY_COC_LIMIT_QUANTA;
      coc_quanta.push_back(static_cast<std::int32_t>(std::clamp(coc, -limit, limit)));
      const float depth = in.depth[from];
      const float background = static_cast<float>(slant * 0.001 * (x + y));
      inverse.push_back(background + (std::isfinite(depth) ? 1 / depth : 0));
    }
  }
  Frame frame = frame_of(c, in);
  frame.coc_quanta = std::move(coc_quanta);
  frame.inverse = std::move(inverse);
  return frame;
}

Frame blurred(const Case& c, Frame frame) {
  const auto seed = static_cast<int>(c.seed % 8);
  const int along_x = seed % 4 != 1, along_y = seed % 4 == 0 ? 0 : seed % 4 == 3 ? -1 : 1;
  const int count = 2 + seed / 4;
  const auto mean_of = [&]<typename T, typename Sum>(Values<T>& plane, Sum, const auto& is_mean) {
    std::vector<T> out;
    for (int y = 0; y < frame.height; ++y) {
      for (int x = 0; x < frame.width; ++x) {
        Sum sum = 0;
        for (int k = 0; k < count; ++k) {
          sum += plane[frame.index_within(x + k * along_x, y + k * along_y)];
        }
        out.push_back(is_mean(x, y) ? static_cast<T>(sum / static_cast<Sum>(count))
                                    : plane[frame.index(x, y)]);
      }
    }
    plane = std::move(out);
  };
  const auto everywhere = [](int, int) { return true; };
  mean_of(frame.coc_quanta, std::int64_t{}, everywhere);
  mean_of(frame.depth, float{}, everywhere);
  for (Values<float>& channel : frame.channels) {
    mean_of(channel, float{}, [](int x, int y) { return (x / 8 + y / 8) % 3 != 0; });
  }
  return frame;
}

Words marks_of(const Case& c, const Frame& frame) {
  const Words mixed = reference::TwinBackend().mixed(frame);
  std::vector<std::uint32_t> marks(mixed.begin(), mixed.end());
  for_each_sprinkled(c, c.seed, [&](std::size_t i) { marks[i] |= DEFRAY_SILHOUETTE; });
  return marks;
}

Words strips_of(const Case& c) {
  std::vector<std::uint32_t> strips(size(c.width) * size(c.height));
  for_each_sprinkled(c, c.seed + 1, [&](std::size_t i) { strips[i] = 1 + c.seed % 7; });
  return strips;
}

Frame soft_fragments(const Case& c, const Input& in) {
  const Frame stage = stage_frame(c, in);
  Frame f = in.fragments;
  const auto coc = f.coc_quanta.edit();
  for (int y = 0; y < c.height; ++y) {
    for (int layer = 0; layer < f.layers; ++layer) {
      for (int x = 0; x < c.width; ++x) {
        if (layer > 0 && c.seed % 2 != 0) continue;
        coc[f.index(x, y, layer)] = stage.coc_quanta[stage.index(x, y)];
      }
    }
  }
  return f;
}

Frame bright_fragments(const Input& in) {
  Frame f = in.fragments;
  if (f.coverage.empty()) f.coverage = Words(f.surfaces(), DEFRAY_WHOLE);
  const auto coverage = f.coverage.edit();
  for (std::size_t i = 0; i < coverage.size(); ++i) {
    if (!is_fragment(f.depth[i])) coverage[i] = 0;
  }
  for (auto& channel : f.channels) {
    const auto plane = channel.edit();
    for (std::size_t i = 5; i < plane.size(); i += 13) plane[i] *= 500;
    // What is a highlight in one half is none in the other.
    for (std::size_t i = 0; i < plane.size(); ++i) {
      const std::size_t x = i % size(f.width), row = i / size(f.width);
      const bool is_wide = f.width > f.height;
      const std::size_t half = size(is_wide ? f.width : f.height * f.layers) / 2;
      if ((is_wide ? x : row) >= half) plane[i] *= 1e6f;
    }
  }
  return f;
}

const ApertureTable& lopsided_aperture() {
  static const ApertureTable table = [] {
    ApertureMask mask;
    for (int row = 0; row < ApertureMask::side; ++row) {
      for (int column = 0; column < ApertureMask::side; ++column) {
        mask.coverage.push_back(static_cast<std::uint8_t>((column / 3 + row / 2 * 3) % 256));
      }
    }
    return make_aperture_table(mask);
  }();
  return table;
}

RayPlan ray_plan(const Case& c) {
  RayPlan plan = plan_rays({c.cells, c.jitter, c.seed});
  if (c.seed % 2 == 0 && !c.jitter) plan.lens.landing_radii = landing_radii(plan.lens);
  plan.has_spans = c.seed % 3 != 0;
  plan.origin_x = static_cast<int>(c.seed % 5) - 2;
  plan.origin_y = static_cast<int>(c.seed % 3);
  if (c.seed % 4 == 1) {
    for (int x = 0; x < c.width; ++x) plan.rim_x.push_back(2000 * (x - c.width / 2));
    for (int y = 0; y < c.height; ++y) plan.rim_y.push_back(-1500 * (y - c.height / 3));
  }
  return plan;
}

DefrayTiltshiftParams tiltshift_case(const Case& c) {
  Random random(0, 0, c.seed);
  TiltshiftSettings s;
  s.band_centre = random.next();
  s.band_width = random.next();
  s.max_blur_px = std::min(c.coc_px, static_cast<double>(linear_max_radius_px));
  const int first_row = static_cast<int>(20 * random.next()) - 10;
  return tiltshift_params(s, c.width, c.height, first_row, c.height + 5);
}

GatherSettings gather_case(GatherKind kind, const Case& c) {
  GatherSettings s;
  s.kind = kind;
  s.samples = c.samples;
  s.passes = 1 + static_cast<int>(c.seed % 2);
  s.rotate = c.jitter;
  s.seed = c.seed;
  return s;
}

}  // namespace defray::validation
