// Kernel `fill` in bands.
#include <algorithm>

#include "chain/stages.h"
#include "opencl/bands.h"

namespace defray {
namespace {

using Words = std::vector<std::uint32_t>;

/// How far `fill` looks from a pixel with this CoC, as the kernel has it.
int fill_reach(std::int32_t farthest, std::int32_t own) { return (farthest - own) / 256 + 2; }

}  // namespace

Words tiles_to_fill(int width, int height, const std::vector<std::int32_t>& coc_quanta,
                    const Words& mixed) {
  constexpr int side = DEFRAY_FILL_TILE;
  const int across = (width + side - 1) / side, down = (height + side - 1) / side;
  std::vector<std::int32_t> nearest(size(across) * size(down), DEFRAY_TAME_QUANTA);
  Words has_mixed(nearest.size()), active(nearest.size());
  std::int32_t farthest = -DEFRAY_TAME_QUANTA;
  for (std::size_t i = 0; i < coc_quanta.size(); ++i) {
    const std::size_t tile = i / size(width) / side * size(across) + i % size(width) / side;
    const std::int32_t coc = tame(coc_quanta[i]);
    nearest[tile] = std::min(nearest[tile], coc);
    farthest = std::max(farthest, coc);
    has_mixed[tile] |= mixed[i];
  }
  for (int y = 0; y < down; ++y) {
    for (int x = 0; x < across; ++x) {
      const std::size_t tile = size(y) * size(across) + size(x);
      const int reach = fill_reach(farthest, nearest[tile]) / side + 1;
      for (int j = std::max(0, y - reach); j <= std::min(down - 1, y + reach); ++j) {
        const std::size_t row = size(j) * size(across);
        const auto first = has_mixed.begin() + std::max(0, x - reach);
        const auto last = has_mixed.begin() + std::min(across - 1, x + reach) + 1;
        const auto offset = static_cast<std::ptrdiff_t>(row);
        if (std::find(first + offset, last + offset, 1u) != last + offset) active[tile] = 1;
      }
    }
  }
  return active;
}

Surface fill(Session& session, const FrameView& f, const Words& mixed, std::size_t memory_bytes) {
  const Words active = tiles_to_fill(f.width, f.height, f.coc_quanta, mixed);
  const auto [least, most] = std::minmax_element(f.coc_quanta.begin(), f.coc_quanta.end());
  const std::int32_t nearest = tame(*least), farthest = tame(*most);
  const int tiles_x = (f.width + DEFRAY_FILL_TILE - 1) / DEFRAY_FILL_TILE;
  const std::size_t pixels = f.coc_quanta.size();
  Surface out{std::vector<std::int32_t>(pixels),
              Plane(pixels),
              std::vector<Plane>(f.channels.size(), Plane(pixels)),
              {}};
  // The first pixels of what was found may be mixed; and colours are looked at further on.
  const std::int64_t reach = std::int64_t{fill_reach(farthest, nearest)} + 3 + 16 + 1;
  constexpr std::size_t bytes_a_pixel = 36 + sizeof(cl_float4);
  for (const Band& b : cut_into_bands(f.height, reach, DEFRAY_FILL_TILE,
                                      size(f.width) * bytes_a_pixel, memory_bytes)) {
    BandOnDevice band(session, b, size(f.width));
    const DefrayFillParams p{word(f.width), word(b.window_rows), word(tiles_x), farthest};
    const ChannelsOnDevice in(band, f.channels);
    const std::size_t tile = size(b.window_y / DEFRAY_FILL_TILE) * size(tiles_x);
    const cl::Buffer coc = band.made<cl_int>(), inverse = band.made<cl_float>();
    const cl::Buffer colour = band.made<cl_float4>();
    band.launch("fill", 1, p, band.view(f.coc_quanta), band.view(f.inverse), band.view(mixed),
                session.view(&active[tile], (active.size() - tile) * sizeof(cl_uint)), in.of[0],
                in.of[1], in.of[2], in.of[3], coc, inverse, colour);
    band.read(coc, out.coc_quanta);
    band.read(inverse, out.inverse);
    band.read(colour, out.channels);
  }
  return out;
}

}  // namespace defray
