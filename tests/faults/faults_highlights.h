#pragma once
// Faults to put into the kernels of the highlights.
#include <vector>

#include "fault.h"

namespace defray::test {

inline std::vector<Fault> highlight_faults() {
  return {
      {"highlights",
       "half as many dim samples suffice",
       {"dim <= count / 2u", "dim <= count / 4u"}},
      {"highlights", "alpha is light", {"channels > 3u ? c.w : c.x", "c.w"}},
      {"highlights", "the sample above the median", {"count / 2u) kept", "count / 2u + 1u) kept"}},
      {"highlights",
       "samples without the frame's last column",
       {"is_inside(p.width, p.height, q)", "is_inside(p.width - 1u, p.height, q)"}},
      {"highlights",
       "surroundings from the layer behind",
       {"(size_t)q.y * p.layers * p.width + (uint)q.x",
        "((size_t)q.y * p.layers + p.layers - 1u) * p.width + (uint)q.x"}},
      {"highlights",
       "made-up surroundings too",
       {"if (coverage[front] >= DEFRAY_SYNTHESISED) continue;", ""}},
      {"highlights", "sharp fragments too", {"share == 0u || coc == 0 ||", "share == 0u ||"}},
      {"highlights", "stale output", {"  kept[own] = 1.0f;\n", ""}},
      {"highlights_add",
       "disc turned by half a turn",
       {"(2L * i + 1L) * (1L << 23) / coc", "(2L * i + 1L) * (1L << 23) / -coc"}},
      {"highlights_add", "off by half a pixel", {"(2L * i + 1L)", "(2L * i)"}},
      {"highlights_add",
       "texels not weighed",
       {"const ulong right = x & 255u, below = y & 255u;",
        "const ulong right = 0u, below = 0u; (void)x;"}},
      {"highlights_add",
       "nothing hides a source",
       {"is_free || !is_hidden(held", "is_free || true || !is_hidden(held"}},
      {"highlights_add",
       "its own surface hides it",
       {"coc_of(coc_quanta, held.x) < source.z - DEFRAY_JUMP_QUANTA", "true"}},
      {"highlights_add",
       "rows and columns of the cell map swapped",
       {"map_entry(eighths.y, coc) * DEFRAY_CELL_MAP + map_entry(eighths.x, coc)",
        "map_entry(eighths.x, coc) * DEFRAY_CELL_MAP + map_entry(eighths.y, coc)"}},
      {"highlights_add",
       "band's first row forgotten",
       {"const uint y = p.band_y + row;\n  const size_t target = (size_t)row * p.width + x;\n  "
        "const uint tile",
        "const uint y = row;\n  const size_t target = (size_t)row * p.width + x;\n  const uint "
        "tile"}},
      {"highlights_add",
       "last source of a tile dropped",
       {"i < first[tile + 1u]", "i + 1u < first[tile + 1u]"}},
      {"highlights_add",
       "what the rim takes is lost",
       {"light /= fmax((float)open * l.share_of_light, 1e-6f);", "(void)open;"}},
      {"highlights_add",
       "rim on the other side",
       {"p.has_rim ? (long2)(rim_x[x], rim_y[y])", "p.has_rim ? -(long2)(rim_x[x], rim_y[y])"}},
      {"highlights_add", "strips as wide as at their top", {"(above + below) / 2L", "above"}},
      {"highlights_add",
       "boxes that reach over the rim are not cut",
       {"max(rim - box.xy, box.zw - rim)", "min(rim - box.xy, box.zw - rim)"}},
      {"highlights_add",
       "half as many strips where pixels are large",
       {"(bottom - top) * 32L", "(bottom - top) * 16L"}},
      {"highlights_add",
       "sharp edges hide by cells",
       {"(float)coverage[own] * (1.0f / DEFRAY_WHOLE)", "0.0f"}},
      {"highlights_add",
       "sharp edges hide lights in front of them",
       {"is_sharp_edge && own_coc < h.z - DEFRAY_JUMP_QUANTA", "is_sharp_edge"}},
      {"highlights_add", "sharp edges hide twice", {"is_veiled && held.x == own", "false"}},
      {"highlights_add",
       "in the means' place",
       {"colour_at(CHANNELS(sum), target) + light", "sum[target] = light;"}},
  };
}

}  // namespace defray::test
