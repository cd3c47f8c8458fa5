#include "stages.h"

#include <algorithm>
#include <cmath>

namespace defray {
namespace {

using Words = std::vector<std::uint32_t>;

std::uint32_t word(int value) { return static_cast<std::uint32_t>(value); }
std::size_t size(int value) { return static_cast<std::size_t>(value); }

/// Four channels on the device: a missing one repeats the last.
struct Channels {
  cl::Buffer of[4];
  Channels(Session& session, const std::vector<Plane>& planes) {
    for (std::size_t c = 0; c < 4; ++c) {
      of[c] = c < planes.size() ? session.picture(planes[c].data(), planes[c].size()) : of[c - 1];
    }
  }
};

template <typename T>
std::vector<T> read(Session& session, const cl::Buffer& buffer, std::size_t count) {
  std::vector<T> values(count);
  session.read(buffer, values.data(), count * sizeof(T));
  return values;
}

std::vector<Plane> read_channels(Session& session, const cl::Buffer& buffer, std::size_t pixels,
                                 std::size_t channels) {
  const auto colours = read<cl_float4>(session, buffer, pixels);
  std::vector<Plane> planes(channels, Plane(pixels));
  for (std::size_t c = 0; c < channels; ++c) {
    for (std::size_t i = 0; i < pixels; ++i) planes[c][i] = colours[i].s[c];
  }
  return planes;
}

/// Runs a kernel of one input and one output plane.
Words words_of(Session& session, const char* kernel, int width, int height,
               const std::vector<std::int32_t>& coc_quanta) {
  const DefrayFrameParams p{word(width), word(height)};
  const cl::Buffer in = session.view(coc_quanta);
  const cl::Buffer out = session.buffer(coc_quanta.size() * sizeof(cl_uint));
  session.launch(kernel, DEFRAY_STAGE_GROUP, {p.width, p.height}, p, in, out);
  return read<std::uint32_t>(session, out, coc_quanta.size());
}

}  // namespace

Words repair(Session& session, int width, int height, const std::vector<std::int32_t>& coc_quanta) {
  return words_of(session, "repair", width, height, coc_quanta);
}

Words edges(Session& session, int width, int height, const std::vector<std::int32_t>& coc_quanta) {
  return words_of(session, "edges", width, height, coc_quanta);
}

Words tiles_to_fill(int width, int height, const std::vector<std::int32_t>& coc_quanta,
                    const Words& mixed) {
  constexpr int side = DEFRAY_FILL_TILE;
  const int across = (width + side - 1) / side, down = (height + side - 1) / side;
  std::vector<std::int32_t> nearest(size(across) * size(down), DEFRAY_TAME_QUANTA);
  Words has_mixed(nearest.size()), active(nearest.size());
  std::int32_t farthest = -DEFRAY_TAME_QUANTA;
  for (std::size_t i = 0; i < coc_quanta.size(); ++i) {
    const std::size_t tile = i / size(width) / side * size(across) + i % size(width) / side;
    const auto coc = std::clamp(coc_quanta[i], -DEFRAY_TAME_QUANTA, DEFRAY_TAME_QUANTA);
    nearest[tile] = std::min(nearest[tile], coc);
    farthest = std::max(farthest, coc);
    has_mixed[tile] |= mixed[i];
  }
  for (int y = 0; y < down; ++y) {
    for (int x = 0; x < across; ++x) {
      const std::size_t tile = size(y) * size(across) + size(x);
      const int reach = ((farthest - nearest[tile]) / 256 + 2) / side + 1;
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

Surface fill(Session& session, const FrameView& f, const Words& mixed) {
  const Words active = tiles_to_fill(f.width, f.height, f.coc_quanta, mixed);
  const auto tiles_x = (f.width + DEFRAY_FILL_TILE - 1) / DEFRAY_FILL_TILE;
  const auto farthest = *std::max_element(f.coc_quanta.begin(), f.coc_quanta.end());
  const DefrayFillParams p{word(f.width), word(f.height), word(tiles_x),
                           std::clamp(farthest, -DEFRAY_TAME_QUANTA, DEFRAY_TAME_QUANTA)};
  const std::size_t pixels = f.coc_quanta.size();
  const Channels in(session, f.channels);
  const cl::Buffer coc = session.buffer(pixels * sizeof(cl_int));
  const cl::Buffer inverse = session.buffer(pixels * sizeof(cl_float));
  const cl::Buffer colour = session.buffer(pixels * sizeof(cl_float4));
  const cl::Buffer coc_in = session.view(f.coc_quanta), inverse_in = session.view(f.inverse);
  const cl::Buffer mixed_in = session.view(mixed), active_in = session.view(active);
  session.launch("fill", DEFRAY_STAGE_GROUP, {p.width, p.height}, p, coc_in, inverse_in, mixed_in,
                 active_in, in.of[0], in.of[1], in.of[2], in.of[3], coc, inverse, colour);
  return {read<std::int32_t>(session, coc, pixels),
          read<float>(session, inverse, pixels),
          read_channels(session, colour, pixels, f.channels.size()),
          {}};
}

Surfaces split(Session& session, const FrameView& f, const Words& mixed, Surface behind) {
  const DefrayFrameParams p{word(f.width), word(f.height)};
  const std::size_t pixels = f.coc_quanta.size(), channels = f.channels.size();
  std::vector<cl_float4> colours(pixels);
  for (std::size_t i = 0; i < pixels; ++i) {
    for (std::size_t c = 0; c < 4; ++c) {
      colours[i].s[c] = behind.channels[std::min(c, channels - 1)][i];
    }
  }
  const auto copied = [&](const auto& values) {
    const std::size_t bytes = values.size() * sizeof(values[0]);
    const cl::Buffer buffer = session.buffer(bytes);
    session.write(buffer, values.data(), bytes);
    return buffer;
  };
  const Channels in(session, f.channels);
  const cl::Buffer coc_in = session.view(f.coc_quanta), inverse_in = session.view(f.inverse);
  const cl::Buffer mixed_in = session.view(mixed);
  const cl::Buffer behind_coc = copied(behind.coc_quanta), behind_inverse = copied(behind.inverse);
  const cl::Buffer behind_colour = copied(colours);
  const cl::Buffer behind_flags = session.buffer(pixels * sizeof(cl_uint));
  const cl::Buffer coc = session.buffer(pixels * sizeof(cl_int));
  const cl::Buffer inverse = session.buffer(pixels * sizeof(cl_float));
  const cl::Buffer colour = session.buffer(pixels * sizeof(cl_float4));
  const cl::Buffer coverage = session.buffer(pixels * sizeof(cl_uint));
  session.launch("split", DEFRAY_STAGE_GROUP, {p.width, p.height}, p, coc_in, inverse_in, mixed_in,
                 in.of[0], in.of[1], in.of[2], in.of[3], behind_coc, behind_inverse, behind_colour,
                 behind_flags, coc, inverse, colour, coverage);
  const auto surface = [&](const cl::Buffer& q, const cl::Buffer& i, const cl::Buffer& c,
                           const cl::Buffer& flags) {
    return Surface{read<std::int32_t>(session, q, pixels), read<float>(session, i, pixels),
                   read_channels(session, c, pixels, channels),
                   read<std::uint32_t>(session, flags, pixels)};
  };
  return {surface(coc, inverse, colour, coverage),
          surface(behind_coc, behind_inverse, behind_colour, behind_flags)};
}

float cells_a_side(int samples) {
  return static_cast<float>(std::sqrt(samples * 4 / 3.14159265358979323846));
}

std::vector<Plane> soften(Session& session, const Fragments& f, int samples) {
  const DefraySoftenParams p{word(f.width), word(f.height), word(f.layers), cells_a_side(samples)};
  const std::size_t count = f.coc_quanta.size();
  const Channels in(session, f.channels);
  const Words whole(f.coverage.empty() ? count : 0, DEFRAY_WHOLE);
  const cl::Buffer coc = session.view(f.coc_quanta);
  const cl::Buffer coverage = session.view(f.coverage.empty() ? whole : f.coverage);
  const cl::Buffer out = session.buffer(count * sizeof(cl_float4));
  session.launch("soften", DEFRAY_STAGE_GROUP, {p.width, std::size_t{p.height} * p.layers}, p, coc,
                 coverage, in.of[0], in.of[1], in.of[2], in.of[3], out);
  return read_channels(session, out, count, f.channels.size());
}

}  // namespace defray
