// rdb_pad, rdb_tiles, rdb_reach: a window of the frame made ready for rdb_gather.
//
// rdb_pad copies planes [window_rows][layers][width] to padded ones, [layers][rows][stride], with a
// run's columns and a tile's rows of nothing around them:
//   key       the least CoC radius that a fragment spans (span.clh), 1/256 px; without spans its
//             own; DEFRAY_NO_KEY where there is no fragment
//   largest   the largest; if has_spans
//   sending   of `sends` in rdb_scatter: turn | (coverage - 1) << 16, no turn where all is covered;
//             if has_coverage
//   coverage  as it is; if has_coverage
//   channels  as they are
// Global size: (runs of a padded row, or its columns (lanes.clh), padded rows x layers).
//
// rdb_tiles finds the bins of CoC radii that a tile's fragments span, in two sets of bits: those of
// whole surfaces that were seen, one a pixel, and those of all others; the least |radius| of all, 0
// where a pixel's front has no fragment; and which rows hold others than plain surfaces. rdb_reach
// adds those of other tiles that may reach it, along x and then, on its own result, along y: `near`
// says which bins reach from how many tiles away, and a square dilates one axis at a time. Integers
// only: the same on every device.
//
// tiles  [tiles_y][tiles_x][2][words]
// least  [tiles_y][tiles_x]            1/256 px
// special_rows [tiles_y][tiles_x]      a bit a row
// near   [reach_tiles + 1][words]
// Global size of both: (tiles_x, tiles_y).
#include "base/colour.clh"
#include "base/pcg3d.clh"
#include "rdb/rays.clh"
#include "rdb/span_run.clh"

// Of a run's coverage: what `sends` in rdb_scatter asks for. What covers all of a pixel sends to
// every cell, whatever its turn.
INLINED ints sending_of(const DefrayRaysParams p, const int x, const int y, const ints share,
                        const ints is_there) {
  const ints sent = as_ints(as_uints(share - (ints)(1)) << 16) & is_there;
  const ints takes_turns = is_there & IS(share != (ints)(DEFRAY_WHOLE));
  if (!any_of(takes_turns)) return sent;
  int turns[LANES];
  for (int i = 0; i < LANES; ++i) {
    const uint2 at = (uint2)((uint)(x + i + p.origin_x), (uint)(y + (int)p.window_y + p.origin_y));
    turns[i] = as_int(pcg3d((uint3)(at, 0u)).z & 0xffffu);
  }
  return sent | (LOAD(turns) & takes_turns);
}

// Copies a run's values to its place in a padded plane.
INLINED void pad(const Fragments f, __global const float* plane, const int3 at,
                 __global float* padded, const size_t to) {
  STORE(as_floats(run_at(f, (__global const int*)plane, at)), padded + to);
}

__kernel void rdb_pad(const DefrayRaysParams p, __global const int* restrict coc_quanta,
                      __global const uint* restrict depth_bits,
                      __global const uint* restrict coverage, CHANNEL_PARAMETERS(channel),
                      __global int* restrict padded_key, __global int* restrict padded_largest,
                      __global uint* restrict padded_sending,
                      __global uint* restrict padded_coverage, WRITTEN_CHANNELS(padded)) {
  const uint column = get_global_id(0) * LANES, line = get_global_id(1);
  const uint rows = p.window_rows + 2u * DEFRAY_RAY_TILE;
  if (column >= p.stride || line >= rows * p.layers) return;
  const int3 at = (int3)((int)column - DEFRAY_RAY_RUN, (int)(line % rows) - DEFRAY_RAY_TILE,
                         (int)(line / rows));
  const size_t to = (size_t)line * p.stride + column;
  const Fragments f = {coc_quanta, depth_bits, p.width, p.layers, p.window_rows};
  Radii own;
  find_run(f, at, &own);
  if (p.has_coverage) {
    const ints covered = run_at(f, (__global const int*)coverage, at);
    const ints share = covered & (ints)((int)~DEFRAY_SYNTHESISED);
    const ints sends = own.is_there & IS(share != (ints)(0));
    STORE(covered, (__global int*)padded_coverage + to);
    STORE(sending_of(p, at.x, at.y, share, sends), (__global int*)padded_sending + to);
    own.is_there = sends;
  }
  ints least = own.radius, largest = own.radius;
  if (p.has_spans && any_of(own.is_there)) find_spans(f, at, &own, &least, &largest);
  const ints none = DEFRAY_NO_KEY;
  STORE((least & own.is_there) | (none & ~own.is_there), padded_key + to);
  if (p.has_spans) {
    STORE((largest & own.is_there) | (none & ~own.is_there), padded_largest + to);
  }
  pad(f, channel0, at, padded0, to);
  pad(f, channel1, at, padded1, to);
  pad(f, channel2, at, padded2, to);
  pad(f, channel3, at, padded3, to);
}

int bin_of(const DefrayRaysParams p, const int radius) {
  return clamp((radius >> p.bin_shift) - p.first_bin, 0, DEFRAY_RAY_BINS - 1);
}

// The least |radius| from `first` to `last`, no less than it.
int least_between(const int first, const int last) {
  return first <= 0 && last >= 0 ? 0 : first > 0 ? first : -last;
}

__kernel void rdb_tiles(const DefrayRaysParams p, __global const int* restrict key,
                        __global const int* restrict largest,
                        __global const uint* restrict coverage, __global ulong* restrict tiles,
                        __global int* restrict least, __global uint* restrict special_rows) {
  const uint tile_x = get_global_id(0), tile_y = get_global_id(1);
  if (tile_x >= p.tiles_x || tile_y >= p.tiles_y) return;
  const int x0 = (int)tile_x * DEFRAY_RAY_TILE, y0 = (int)tile_y * DEFRAY_RAY_TILE;
  const int x1 = min(x0 + DEFRAY_RAY_TILE, (int)p.width);
  const int y1 = min(y0 + DEFRAY_RAY_TILE, (int)p.window_rows);
  ulong found[2 * DEFRAY_RAY_WORDS];
  for (int w = 0; w < 2 * DEFRAY_RAY_WORDS; ++w) found[w] = 0ul;
  int least_found = INT_MAX;
  uint rows = 0u;
  for (uint layer = 0; layer < p.layers; ++layer) {
    for (int y = y0; y < y1; ++y) {
      const size_t row = padded_layer(p) * layer + padded_at(p, 0, y);
      // Most rows of layers behind are empty, and so is what lies beside the frame.
      if (layer > 0u && !any(vload16(0, key + row + x0) != (int16)(DEFRAY_NO_KEY))) continue;
      for (int x = x0; x < x1; ++x) {
        const int quanta = key[row + x];
        if (quanta == DEFRAY_NO_KEY) {
          if (layer == 0u) least_found = 0;
          continue;
        }
        const int last = p.has_spans ? largest[row + x] : quanta;
        least_found = min(least_found, least_between(quanta, last));
        const bool is_plain = layer == 0u && (!p.has_coverage || coverage[row + x] == DEFRAY_WHOLE);
        if (!is_plain) rows |= 1u << (y - y0);
        const int last_bin = bin_of(p, last);
        for (int bin = bin_of(p, quanta); bin <= last_bin; ++bin) {
          found[(is_plain ? 0 : DEFRAY_RAY_WORDS) + bin / 64] |= 1ul << (bin % 64);
        }
      }
    }
  }
  least[tile_y * p.tiles_x + tile_x] = least_found;
  special_rows[tile_y * p.tiles_x + tile_x] = rows;
  const size_t to = (size_t)(tile_y * p.tiles_x + tile_x) * (2 * DEFRAY_RAY_WORDS);
  for (int w = 0; w < 2 * DEFRAY_RAY_WORDS; ++w) tiles[to + w] = found[w];
}

__kernel void rdb_reach(const DefrayRaysParams p, __global const ulong* restrict near,
                        __global const ulong* restrict tiles, __global ulong* restrict reach) {
  const int tile_x = (int)get_global_id(0), tile_y = (int)get_global_id(1);
  if (tile_x >= (int)p.tiles_x || tile_y >= (int)p.tiles_y) return;
  const int here = p.along_y ? tile_y : tile_x;
  const int last = min(here + p.reach_tiles, (int)(p.along_y ? p.tiles_y : p.tiles_x) - 1);
  const int step = p.along_y ? (int)p.tiles_x : 1;
  const int own = tile_y * (int)p.tiles_x + tile_x;
  ulong found[2 * DEFRAY_RAY_WORDS];
  for (int w = 0; w < 2 * DEFRAY_RAY_WORDS; ++w) found[w] = 0ul;
  for (int i = max(here - p.reach_tiles, 0); i <= last; ++i) {
    const size_t theirs = (size_t)(own + (i - here) * step) * (2 * DEFRAY_RAY_WORDS);
    const size_t away = (size_t)abs(i - here) * DEFRAY_RAY_WORDS;
    for (int w = 0; w < 2 * DEFRAY_RAY_WORDS; ++w) {
      found[w] |= tiles[theirs + w] & near[away + w % DEFRAY_RAY_WORDS];
    }
  }
  for (int w = 0; w < 2 * DEFRAY_RAY_WORDS; ++w) {
    reach[(size_t)own * (2 * DEFRAY_RAY_WORDS) + w] = found[w];
  }
}
