// The table's entries for the stages before the RDB. What one stage needs of another is made by the
// twins, so that each kernel is tried alone.
#include <algorithm>
#include <cmath>

#include "reference/stages.h"
#include "validation/kernel_checks.h"

namespace defray::validation {
namespace {

double pixels(const Case& c) { return static_cast<double>(c.width) * c.height; }

/// The case's frame as stages are meant to see it: patterns without surfaces become blocks of 9 x 6
/// pixels with thin columns between them, two seeds of three slant all surfaces, and depth is
/// 1/depth with the background at 0.
struct StageFrame {
  int width, height;
  std::vector<std::int32_t> coc_quanta;
  Plane inverse;
  const std::vector<Plane>& channels;
  std::vector<std::uint32_t> mixed;

  StageFrame(const Case& c, const Input& in)
      : width(c.width), height(c.height), channels(in.channels) {
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
    mixed = reference::edges(width, height, coc_quanta);
  }

  FrameView view() const { return {width, height, coc_quanta, inverse, channels}; }
};

/// The frame's CoC with anti-aliased steps: means of two or three pixels along a direction.
std::vector<std::int32_t> blurred(const Case& c, const StageFrame& frame) {
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
  return out;
}

Values words(const std::vector<std::uint32_t>& values) {
  return {{values.begin(), values.end()}, {}};
}

/// Surfaces one after the other: whole numbers, then colours and 1/depth.
Values values_of(const std::vector<Surface>& surfaces) {
  Values v;
  for (const Surface& s : surfaces) {
    v.integers.insert(v.integers.end(), s.coc_quanta.begin(), s.coc_quanta.end());
    v.integers.insert(v.integers.end(), s.coverage.begin(), s.coverage.end());
    v.planes.insert(v.planes.end(), s.channels.begin(), s.channels.end());
    v.planes.push_back(s.inverse);
  }
  return v;
}

Values run_repair(Session& session, const Case& c, const Input& in) {
  return words(repair(session, c.width, c.height, blurred(c, StageFrame(c, in)), stage_memory(c)));
}

Values twin_repair(const Case& c, const Input& in) {
  return words(reference::repair(c.width, c.height, blurred(c, StageFrame(c, in))));
}

double repair_work(const Case& c) { return 100 * pixels(c) + band_work(c); }

Values run_edges(Session& session, const Case& c, const Input& in) {
  return words(edges(session, c.width, c.height, StageFrame(c, in).coc_quanta, stage_memory(c)));
}

Values twin_edges(const Case& c, const Input& in) {
  return words(reference::edges(c.width, c.height, StageFrame(c, in).coc_quanta));
}

double edges_work(const Case& c) { return 20 * pixels(c) + band_work(c); }

Values run_fill(Session& session, const Case& c, const Input& in) {
  const StageFrame frame(c, in);
  return values_of({fill(session, frame.view(), frame.mixed, stage_memory(c))});
}

Values twin_fill(const Case& c, const Input& in) {
  const StageFrame frame(c, in);
  return values_of({reference::fill(frame.view(), frame.mixed)});
}

/// Steps of all ways over the picture: each grows by a 16th of the distance.
double fill_work(const Case& c) {
  const double across = std::max(c.width, c.height);
  const double steps = std::min(2 * c.coc_px, across) / 16;
  return pixels(c) * DEFRAY_FILL_DIRECTIONS * (2 + 16 * std::log1p(steps)) + band_work(c);
}

Values run_split(Session& session, const Case& c, const Input& in) {
  const StageFrame frame(c, in);
  const auto [front, behind] = split(session, frame.view(), frame.mixed,
                                     reference::fill(frame.view(), frame.mixed), stage_memory(c));
  return values_of({front, behind});
}

Values twin_split(const Case& c, const Input& in) {
  const StageFrame frame(c, in);
  const auto [front, behind] =
      reference::split(frame.view(), frame.mixed, reference::fill(frame.view(), frame.mixed));
  return values_of({front, behind});
}

double split_work(const Case& c) { return 200 * pixels(c) + 2 * fill_work(c); }

/// The case's fragments with CoC radii that lie together.
Fragments soft_fragments(const Case& c, const Input& in) {
  const StageFrame frame(c, in);
  Fragments f = in.fragments;
  for (int y = 0; y < c.height; ++y) {
    for (int layer = 0; layer < f.layers; ++layer) {
      for (int x = 0; x < c.width; ++x) {
        const std::size_t at = f.index(x, y, layer);
        if (layer == 0 || c.seed % 2 == 0) {
          f.coc_quanta[at] =
              frame.coc_quanta[static_cast<std::size_t>(y) * static_cast<std::size_t>(c.width) +
                               static_cast<std::size_t>(x)];
        }
      }
    }
  }
  return f;
}

/// Each layer of each channel as a picture.
Values layers_of(const Fragments& f, const std::vector<Plane>& channels) {
  Values v;
  for (int layer = 0; layer < f.layers; ++layer) {
    for (const Plane& channel : channels) {
      Plane& plane = v.planes.emplace_back();
      for (int y = 0; y < f.height; ++y) {
        for (int x = 0; x < f.width; ++x) plane.push_back(channel[f.index(x, y, layer)]);
      }
    }
  }
  return v;
}

Values run_soften(Session& session, const Case& c, const Input& in) {
  const Fragments f = soft_fragments(c, in);
  return layers_of(f, soften(session, f, c.cells * c.cells, stage_memory(c)));
}

Values twin_soften(const Case& c, const Input& in) {
  const Fragments f = soft_fragments(c, in);
  return layers_of(f, reference::soften(f, c.cells * c.cells));
}

double soften_work(const Case& c) { return 300 * pixels(c) + band_work(c); }

constexpr const char* integer_rule = "equal: integer arithmetic";
constexpr const char* bits_rule = "equal bits: + - x / in one order";

}  // namespace

std::size_t stage_memory(const Case& c) { return c.band_rows > 0 ? 1 : default_memory_bytes; }

double band_work(const Case& c) { return c.band_rows > 0 ? 1e4 * c.height : 0; }

std::vector<KernelCheck> stage_checks() {
  return {{"edges", integer_rule, run_edges, twin_edges, edges_work},
          {"fill", bits_rule, run_fill, twin_fill, fill_work},
          {"repair", integer_rule, run_repair, twin_repair, repair_work},
          {"soften", bits_rule, run_soften, twin_soften, soften_work},
          {"split", bits_rule, run_split, twin_split, split_work}};
}

}  // namespace defray::validation
