#include "chain/stages.h"

#include <algorithm>
#include <cmath>

#include "opencl/bands.h"

namespace defray {
namespace {

using Words = std::vector<std::uint32_t>;

DefrayFrameParams window_of(int width, const Band& band) {
  return {word(width), word(band.window_rows)};
}

/// What an output plane holds: of indices, kernels count from the window's first pixel.
enum class Holds { values, indices };

/// Runs a kernel of one input and one output plane that looks `reach` pixels around.
Words words_of(Session& session, const char* kernel, int width, int height, int reach,
               const std::vector<std::int32_t>& coc_quanta, std::size_t memory_bytes,
               Holds holds = Holds::values) {
  constexpr std::size_t bytes_a_pixel = sizeof(cl_int) + sizeof(cl_uint);
  Words out(coc_quanta.size());
  for (const Band& b :
       cut_into_bands(height, reach, 1, size(width) * bytes_a_pixel, memory_bytes)) {
    BandOnDevice band(session, b, size(width));
    const cl::Buffer made = band.made<cl_uint>();
    band.launch(kernel, 1, window_of(width, b), band.view(coc_quanta), made);
    band.read(made, out);
    if (holds == Holds::values) continue;
    const std::size_t first = size(b.y) * size(width), end = first + size(b.rows) * size(width);
    for (std::size_t i = first; i < end; ++i) out[i] += static_cast<std::uint32_t>(band.first());
  }
  return out;
}

}  // namespace

Words repair(Session& session, int width, int height, const std::vector<std::int32_t>& coc_quanta,
             std::size_t memory_bytes) {
  return words_of(session, "repair", width, height, 3, coc_quanta, memory_bytes, Holds::indices);
}

Words edges(Session& session, int width, int height, const std::vector<std::int32_t>& coc_quanta,
            std::size_t memory_bytes) {
  return words_of(session, "edges", width, height, 1, coc_quanta, memory_bytes);
}

Surfaces split(Session& session, const FrameView& f, const Words& mixed, Surface behind,
               std::size_t memory_bytes) {
  const std::size_t pixels = f.coc_quanta.size();
  behind.coverage.resize(pixels);
  Surface front{std::vector<std::int32_t>(pixels), Plane(pixels),
                std::vector<Plane>(f.channels.size(), Plane(pixels)), Words(pixels)};
  constexpr std::size_t bytes_a_pixel = 52 + 2 * sizeof(cl_float4);
  constexpr int reach = 3;
  for (const Band& b :
       cut_into_bands(f.height, reach, 1, size(f.width) * bytes_a_pixel, memory_bytes)) {
    BandOnDevice band(session, b, size(f.width));
    const ChannelsOnDevice in(band, f.channels);
    const cl::Buffer behind_coc = band.copy(behind.coc_quanta);
    const cl::Buffer behind_inverse = band.copy(behind.inverse);
    const cl::Buffer behind_colour = band.copy(behind.channels);
    const cl::Buffer behind_flags = band.made<cl_uint>(), coverage = band.made<cl_uint>();
    const cl::Buffer coc = band.made<cl_int>(), inverse = band.made<cl_float>();
    const cl::Buffer colour = band.made<cl_float4>();
    band.launch("split", 1, window_of(f.width, b), band.view(f.coc_quanta), band.view(f.inverse),
                band.view(mixed), in.of[0], in.of[1], in.of[2], in.of[3], behind_coc,
                behind_inverse, behind_colour, behind_flags, coc, inverse, colour, coverage);
    const auto read = [&](Surface& s, const cl::Buffer& q, const cl::Buffer& i, const cl::Buffer& c,
                          const cl::Buffer& flags) {
      band.read(q, s.coc_quanta);
      band.read(i, s.inverse);
      band.read(c, s.channels);
      band.read(flags, s.coverage);
    };
    read(front, coc, inverse, colour, coverage);
    read(behind, behind_coc, behind_inverse, behind_colour, behind_flags);
  }
  return {std::move(front), std::move(behind)};
}

float cells_a_side(int samples) {
  return static_cast<float>(std::sqrt(samples * 4 / 3.14159265358979323846));
}

std::vector<Plane> soften(Session& session, const Fragments& f, int samples,
                          std::size_t memory_bytes) {
  const std::size_t count = f.coc_quanta.size(), stride = size(f.width) * size(f.layers);
  const Words whole(f.coverage.empty() ? count : 0, DEFRAY_WHOLE);
  std::vector<Plane> out(f.channels.size(), Plane(count));
  const float cells = cells_a_side(samples);
  const auto reach = static_cast<std::int64_t>(
      static_cast<float>(largest_coc(f.coc_quanta)) * px_per_quantum / cells + 1);
  constexpr std::size_t bytes_a_fragment = 24 + sizeof(cl_float4);
  for (const Band& b :
       cut_into_bands(f.height, reach, 1, stride * bytes_a_fragment, memory_bytes)) {
    BandOnDevice band(session, b, stride);
    const DefraySoftenParams p{word(f.width), word(b.window_rows), word(f.layers), cells};
    const ChannelsOnDevice in(band, f.channels);
    const cl::Buffer made = band.made<cl_float4>();
    band.launch("soften", f.layers, p, band.view(f.coc_quanta),
                band.view(f.coverage.empty() ? whole : f.coverage), in.of[0], in.of[1], in.of[2],
                in.of[3], made);
    band.read(made, out);
  }
  return out;
}

}  // namespace defray
