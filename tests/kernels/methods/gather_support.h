#pragma once
// What the tests of gathers draw and ask for.
#include "methods/gather.h"
#include "support.h"

namespace defray::test::gather_test {

inline constexpr GatherKind kinds[] = {GatherKind::literal, GatherKind::aware};

inline std::vector<Plane> planes_of(Size size) {
  std::vector<Plane> planes;
  for (std::uint32_t c = 0; c < 4; ++c) planes.push_back(random_plane(size, c + 5));
  return planes;
}

inline std::vector<Plane> render(Size size, const std::vector<std::int32_t>& coc,
                                 const std::vector<Plane>& channels,
                                 const GatherSettings& settings) {
  return taken(device().gather({size.width, size.height, coc, {}, channels}, settings));
}

inline GatherSettings settings_of(GatherKind kind, int samples, int passes, bool rotate) {
  GatherSettings s;
  s.kind = kind;
  s.samples = samples;
  s.passes = passes;
  s.rotate = rotate;
  return s;
}

}  // namespace defray::test::gather_test
