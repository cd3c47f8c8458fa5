#pragma once
// The stages before the ray distribution buffers: what a frame's pixels are made of. Each runs one
// kernel over a frame, in bands of rows that take at most `memory_bytes` of the device with the
// rows that they look at (unless that is more already); the scalar twins have the same names in
// defray::reference.
#include <cstdint>
#include <vector>

#include "opencl/session.h"
#include "rdb/fragments.h"

namespace defray {

/// A frame's planes, all [height][width].
struct FrameView {
  int width, height;
  const std::vector<std::int32_t>& coc_quanta;  ///< Signed radius, 1/256 px.
  const Plane& inverse;                         ///< 1/depth; 0: background.
  const std::vector<Plane>& channels;           ///< 1 to 4.
};

/// One surface of each pixel, [height][width].
struct Surface {
  std::vector<std::int32_t> coc_quanta;
  Plane inverse;  ///< 1/depth; negative where there is no fragment.
  std::vector<Plane> channels;
  std::vector<std::uint32_t> coverage;  ///< 2^-16 of the pixel, with DEFRAY_SYNTHESISED.
};

/// What the stages have found out about a frame.
struct Surfaces {
  Surface front, behind;
};

/// Kernel `repair`: for each pixel the index of the one whose depth it should have, itself but for
/// pixels of anti-aliased depth, which lie between two surfaces.
std::vector<std::uint32_t> repair(Session& session, int width, int height,
                                  const std::vector<std::int32_t>& coc_quanta,
                                  std::size_t memory_bytes = default_memory_bytes);

/// Kernel `edges`: 1 where a pixel has neighbours on another surface.
std::vector<std::uint32_t> edges(Session& session, int width, int height,
                                 const std::vector<std::int32_t>& coc_quanta,
                                 std::size_t memory_bytes = default_memory_bytes);

/// Tiles of DEFRAY_FILL_TILE pixels a side with a mixed pixel close enough to matter: elsewhere
/// nothing lies behind. [tiles_y][tiles_x]. Host code for kernel and twin alike.
std::vector<std::uint32_t> tiles_to_fill(int width, int height,
                                         const std::vector<std::int32_t>& coc_quanta,
                                         const std::vector<std::uint32_t>& mixed);

/// Kernel `fill`: what lies behind each pixel, as far as the lens can uncover it; coverage is left
/// empty.
Surface fill(Session& session, const FrameView& frame, const std::vector<std::uint32_t>& mixed,
             std::size_t memory_bytes = default_memory_bytes);

/// Kernel `split`: mixed pixels taken apart. `behind` is what `fill` gave.
Surfaces split(Session& session, const FrameView& frame, const std::vector<std::uint32_t>& mixed,
               Surface behind, std::size_t memory_bytes = default_memory_bytes);

/// Kernel `soften`: colours averaged over what one of `samples` lens points stands for.
std::vector<Plane> soften(Session& session, const Fragments& fragments, int samples,
                          std::size_t memory_bytes = default_memory_bytes);

/// Cells a side of a square grid as dense as `samples` points in a disc: sqrt(4 samples / pi).
float cells_a_side(int samples);

}  // namespace defray
