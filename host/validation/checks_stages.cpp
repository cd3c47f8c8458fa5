// The table's entries for the stages before the RDB. What one stage needs of another is made by the
// twins, so that each kernel is tried alone.
#include <bit>

#include "reference/twin_backend.h"
#include "validation/kernel_checks.h"
#include "validation/stage_input.h"
#include "validation/work.h"

namespace defray::validation {
namespace {

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

Outcome run_repair(Backend& backend, const Case& c, const Input& in) {
  return words(backend.repair(blurred(c, stage_frame(c, in))));
}

Outcome run_mixed(Backend& backend, const Case& c, const Input& in) {
  return words(backend.mixed(stage_frame(c, in)));
}

/// Of `fill`: either number, by the case.
int directions_of(const Case& c) { return c.seed % 2 ? DEFRAY_FILL_DIRECTIONS : 8; }

Outcome run_fill(Backend& backend, const Case& c, const Input& in) {
  const Frame f = stage_frame(c, in);
  return values_of({backend.fill(f, marks_of(c, f), directions_of(c))});
}

Outcome run_feather(Backend& backend, const Case& c, const Input& in) {
  const Frame f = stage_frame(c, in);
  const Words marks = marks_of(c, f);
  const Frame behind = reference::TwinBackend().fill(f, marks, directions_of(c));
  Outcome v;
  for (const auto& channel : backend.feather(behind, f.coc_quanta, marks, strips_of(c))) {
    add_plane(v, channel.host());
  }
  return v;
}

std::size_t split_memory(const Case& c, const Input&) { return band_memory("split", c, 2); }

/// With a margin.
Outcome run_split(Backend& backend, const Case& c, const Input& in) {
  reference::TwinBackend twins;
  Frame f = stage_frame(c, in);
  const Words mixed = twins.mixed(f);
  f.margin = static_cast<int>(c.seed % 4);
  const Frame layers = backend.split(f, mixed, twins.fill(f, mixed, directions_of(c)));
  Outcome v = values_of({layers});
  for (std::size_t i = 0; i < layers.depth.size(); ++i) {
    v.integers.push_back(std::bit_cast<std::int32_t>(layers.depth[i]));
  }
  return v;
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

std::size_t soften_memory(const Case& c, const Input& in) {
  return band_memory("soften", c, in.fragments.layers);
}

Outcome run_soften(Backend& backend, const Case& c, const Input& in) {
  const Frame f = soft_fragments(c, in);
  return layers_of(f, backend.soften(f, c.cells * c.cells));
}

}  // namespace

std::vector<KernelCheck> stage_checks() {
  return {{"mixed", integer_rule, run_mixed, mixed_work},
          {"fill", bits_rule, run_fill, fill_work},
          {"feather", bits_rule, run_feather, feather_work},
          {"repair", integer_rule, run_repair, repair_work},
          {"soften", bits_rule, run_soften, soften_work, nullptr, nullptr, soften_memory},
          {"split", bits_rule, run_split, split_work, nullptr, nullptr, split_memory}};
}

}  // namespace defray::validation
