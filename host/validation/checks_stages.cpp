// The table's entries for the stages before the RDB. What one stage needs of another is made by the
// twins, so that each kernel is tried alone.
#include <algorithm>
#include <bit>
#include <cmath>

#include "reference/twin_stages.h"
#include "validation/kernel_checks.h"

namespace defray::validation {
namespace {

double pixels(const Case& c) { return static_cast<double>(c.width) * c.height; }

/// The case's frame as stages are meant to see it: patterns without surfaces become blocks of 9 x 6
/// pixels with thin columns between them, two seeds of three slant all surfaces, and depth is
/// 1/depth with the background at 0.
struct StageFrame {
  Frame frame;
  Words mixed;

  StageFrame(const Case& c, const Input& in) : frame(frame_of(c, in)) {
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
    frame.coc_quanta = std::move(coc_quanta);
    frame.inverse = std::move(inverse);
    mixed = reference::TwinStages().edges(frame);
  }
};

/// The frame's CoC with anti-aliased steps: means of two or three pixels along a direction.
Frame blurred(const Case& c, Frame frame) {
  const auto seed = static_cast<int>(c.seed % 8);
  const int along_x = seed % 4 != 1, along_y = seed % 4 == 0 ? 0 : seed % 4 == 3 ? -1 : 1;
  const int count = 2 + seed / 4;
  std::vector<std::int32_t> out;
  for (int y = 0; y < frame.height; ++y) {
    for (int x = 0; x < frame.width; ++x) {
      std::int64_t sum = 0;
      for (int k = 0; k < count; ++k) {
        const int px = std::clamp(x + k * along_x, 0, frame.width - 1);
        const int py = std::clamp(y + k * along_y, 0, frame.height - 1);
        sum +=
            frame.coc_quanta[static_cast<std::size_t>(py) * static_cast<std::size_t>(frame.width) +
                             static_cast<std::size_t>(px)];
      }
      out.push_back(static_cast<std::int32_t>(sum / count));
    }
  }
  frame.coc_quanta = std::move(out);
  return frame;
}

Outcome words(const Words& values) { return {{values.begin(), values.end()}, {}}; }

void add_plane(Outcome& v, std::span<const float> plane) {
  v.planes.emplace_back(plane.begin(), plane.end());
}

/// Surfaces one after the other: whole numbers, then colours and 1/depth.
Outcome values_of(const std::vector<Frame>& surfaces) {
  Outcome v;
  for (const Frame& s : surfaces) {
    v.integers.insert(v.integers.end(), s.coc_quanta.begin(), s.coc_quanta.end());
    v.integers.insert(v.integers.end(), s.coverage.begin(), s.coverage.end());
    for (const auto& channel : s.channels) add_plane(v, channel.host());
    add_plane(v, s.inverse.host());
  }
  return v;
}

Outcome run_repair(Stages& stages, const Case& c, const Input& in) {
  return words(stages.repair(blurred(c, StageFrame(c, in).frame)));
}

double repair_work(const Case& c) { return 100 * pixels(c) + band_work(c); }

Outcome run_edges(Stages& stages, const Case& c, const Input& in) {
  return words(stages.edges(StageFrame(c, in).frame));
}

double edges_work(const Case& c) { return 20 * pixels(c) + band_work(c); }

Outcome run_fill(Stages& stages, const Case& c, const Input& in) {
  const StageFrame f(c, in);
  return values_of({stages.fill(f.frame, f.mixed)});
}

/// Steps of all ways over the picture: each grows by a 16th of the distance.
double fill_work(const Case& c) {
  const double across = std::max(c.width, c.height);
  const double steps = std::min(2 * c.coc_px, across) / 16;
  return pixels(c) * DEFRAY_FILL_DIRECTIONS * (2 + 16 * std::log1p(steps)) + band_work(c);
}

Outcome run_split(Stages& stages, const Case& c, const Input& in) {
  const StageFrame f(c, in);
  const auto [front, behind] =
      stages.split(f.frame, f.mixed, reference::TwinStages().fill(f.frame, f.mixed));
  return values_of({front, behind});
}

/// What `fill` and `split` left, with a margin.
Outcome run_assemble(Stages& stages, const Case& c, const Input& in) {
  reference::TwinStages twins;
  StageFrame f(c, in);
  f.frame.margin = static_cast<int>(c.seed % 4);
  const Frame both = stages.assemble(twins.split(f.frame, f.mixed, twins.fill(f.frame, f.mixed)));
  Outcome v = values_of({both});
  for (std::size_t i = 0; i < both.depth.size(); ++i) {
    v.integers.push_back(std::bit_cast<std::int32_t>(both.depth[i]));
  }
  return v;
}

double split_work(const Case& c) { return 200 * pixels(c) + 2 * fill_work(c); }

/// The case's fragments with CoC radii that lie together.
Frame soft_fragments(const Case& c, const Input& in) {
  const StageFrame stage(c, in);
  Frame f = in.fragments;
  const auto coc = f.coc_quanta.edit();
  for (int y = 0; y < c.height; ++y) {
    for (int layer = 0; layer < f.layers; ++layer) {
      for (int x = 0; x < c.width; ++x) {
        if (layer > 0 && c.seed % 2 != 0) continue;
        coc[f.index(x, y, layer)] = stage.frame.coc_quanta[stage.frame.index(x, y)];
      }
    }
  }
  return f;
}

/// Each layer of each channel as a picture.
Outcome layers_of(const Frame& f, const Planes& channels) {
  Outcome v;
  for (int layer = 0; layer < f.layers; ++layer) {
    for (const auto& channel : channels) {
      Plane& plane = v.planes.emplace_back();
      for (int y = 0; y < f.height; ++y) {
        for (int x = 0; x < f.width; ++x) plane.push_back(channel[f.index(x, y, layer)]);
      }
    }
  }
  return v;
}

Outcome run_soften(Stages& stages, const Case& c, const Input& in) {
  const Frame f = soft_fragments(c, in);
  return layers_of(f, stages.soften(f, c.cells * c.cells));
}

double soften_work(const Case& c) { return 300 * pixels(c) + band_work(c); }

constexpr const char* integer_rule = "equal: integer arithmetic";
constexpr const char* bits_rule = "equal bits: + - x / in one order";

}  // namespace

double band_work(const Case& c) {
  constexpr double launch_work = 4e4;
  return c.band_rows > 0 ? launch_work * std::ceil(c.height / double(c.band_rows)) : launch_work;
}

std::vector<KernelCheck> stage_checks() {
  return {{"assemble", bits_rule, run_assemble, split_work},
          {"edges", integer_rule, run_edges, edges_work},
          {"fill", bits_rule, run_fill, fill_work},
          {"repair", integer_rule, run_repair, repair_work},
          {"soften", bits_rule, run_soften, soften_work},
          {"split", bits_rule, run_split, split_work}};
}

}  // namespace defray::validation
