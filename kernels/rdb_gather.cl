// rdb_gather: what rdb_scatter and rdb_merge compute, bit for bit, from where the rays end.
//
// Through one lens point u a radius r lands at the offset landing(r u), which changes at known
// radii: the segments (dx, dy, least radius, span), the same for all pixels. In a segment a target
// sees one source pixel, (dx, dy) before it, and its ray arrives exactly if its radius is in the
// segment. Segments come in ascending radius: what arrives first is the nearest, and the cell is
// done. No winners are stored and none is compared. Cells are added in the lens's order, as
// rdb_merge adds them: the same sums.
//
// A tile's bins say which radii there are within reach; only segments that meet them are looked at.
//
// keys, sending, coverage, channel0..3   padded planes of the window, from rdb_pad
// segments        in the order of cells, radii ascending within each
// first           [cells][bins + 1]  the first segment that reaches into a bin; at last, one past the
//                                    cell's
// occupied        [tiles][2][words]  from rdb_reach
// sharp           [words]            bins whose rays end where they begin, whatever the lens point
// lens, rim_x, rim_y                 as in rdb_merge
// light_first     [light tiles + 1]  as `first` in highlights_add
// winner          [cells][band_rows][width]  (x: source in the window, y: key) where highlights_add
//                                    or rdb_nearest ask for it
// mean0..3, seen  [band_rows][width]
// Global size: strips of DEFRAY_RAY_RUN x DEFRAY_RAY_ROWS targets.
#include "colour.clh"
#include "rays.clh"
#include "rim.clh"

#define ROWS DEFRAY_RAY_ROWS
#define EACH_ROW _Pragma("unroll") for (int j = 0; j < ROWS; ++j)

// The bins within reach, as runs [x, y) of them: one list for all cells.
typedef struct {
  int count;
  short2 run[DEFRAY_RAY_BINS / 2];
} Runs;

// A strip's place, and its sums.
typedef struct {
  int x, y;  // in the frame
  size_t own;  // in padded planes
  int16 inside[ROWS];
  float16 total0[ROWS], total1[ROWS], total2[ROWS], total3[ROWS];
  int16 differs[ROWS], count[ROWS], seen[ROWS];
} Strip;

typedef struct {
  __global const int* keys;
  __global const uint* sending;
  __global const uint* coverage;
  __global const float* channel0;
  __global const float* channel1;
  __global const float* channel2;
  __global const float* channel3;
  __global const int4* segments;
  __global const int* first;
} Rays;

bool any_of(const int16 v) {
  const int8 a = v.lo | v.hi;
  const int4 b = a.lo | a.hi;
  const int2 c = b.lo | b.hi;
  return (c.x | c.y) != 0;
}

int16 bits_at(__global const float* plane, const size_t at) {
  return as_int16(vload16(0, plane + at));
}

void find_runs(__global const ulong* plain, __global const ulong* special, Runs* runs) {
  runs->count = 0;
  bool is_in_run = false;
  for (int b = 0; b < DEFRAY_RAY_BINS; ++b) {
    const ulong word = plain[b / 64] | special[b / 64];
    const bool is_set = (word >> (b % 64) & 1ul) != 0ul;
    if (is_set && !is_in_run) runs->run[runs->count].x = (short)b;
    if (!is_set && is_in_run) runs->run[runs->count++].y = (short)b;
    is_in_run = is_set;
  }
  if (is_in_run) runs->run[runs->count++].y = DEFRAY_RAY_BINS;
}

// Of a strip and a segment: whether its sources are in the window at all, and where.
bool sources_of(const DefrayRaysParams p, const Strip* strip, const int4 segment, size_t* at) {
  const int sx = strip->x - segment.x, sy = strip->y - segment.y - (int)p.window_y;
  if (sx <= -DEFRAY_RAY_RUN || sx >= (int)p.width) return false;
  if (sy <= -ROWS || sy >= (int)p.window_rows) return false;
  *at = padded_at(p, sx, sy);
  return true;
}

// Adds colours where `hit`.
void add(Strip* s, const Rays* r, const int j, const int16 hit, const int16 c0, const int16 c1,
         const int16 c2, const int16 c3, const size_t own) {
  s->total0[j] += as_float16(c0 & hit);
  s->total1[j] += as_float16(c1 & hit);
  s->total2[j] += as_float16(c2 & hit);
  s->total3[j] += as_float16(c3 & hit);
  const int16 d = (c0 ^ bits_at(r->channel0, own)) | (c1 ^ bits_at(r->channel1, own)) |
                  (c2 ^ bits_at(r->channel2, own)) | (c3 ^ bits_at(r->channel3, own));
  s->differs[j] |= d & hit;
  s->count[j] -= hit;
}

// One whole surface a pixel, all of it seen, no rim, nobody asks for winners.
void gather_plain(const DefrayRaysParams p, const Rays* r, const Runs* runs, Strip* s) {
  const size_t stride = p.stride;
  for (uint k = 0; k < p.cells; ++k) {
    __global const int* first = r->first + k * (DEFRAY_RAY_BINS + 1);
    const int end_of_cell = first[DEFRAY_RAY_BINS];
    int16 open[ROWS];
    EACH_ROW open[j] = s->inside[j];
    bool is_open = true;
    int at = 0;
    for (int i = 0; i < runs->count && is_open; ++i) {
      const int end = min(first[runs->run[i].y] + 1, end_of_cell);
      for (at = max(at, first[runs->run[i].x]); at < end && is_open; ++at) {
        const int4 segment = r->segments[at];
        size_t from;
        if (!sources_of(p, s, segment, &from)) continue;
        int16 left = 0;
        EACH_ROW {
          const size_t source = from + j * stride;
          const int16 key = vload16(0, r->keys + source);
          const int16 hit = open[j] & (as_uint16(key - segment.z) <= (uint16)(uint)segment.w);
          add(s, r, j, hit, bits_at(r->channel0, source), bits_at(r->channel1, source),
              bits_at(r->channel2, source), bits_at(r->channel3, source), s->own + j * stride);
          open[j] &= ~hit;
          left |= open[j];
        }
        is_open = any_of(left);
      }
    }
  }
}

// What shows through where no ray arrives, of each target: as farthest_behind in rdb_merge.
typedef struct {
  int16 there[ROWS], was_seen[ROWS];
  int16 channel0[ROWS], channel1[ROWS], channel2[ROWS], channel3[ROWS];
} Behind;

// The place of the farthest fragment behind a pixel and those around it; that of the pixel itself in
// layer 0 if there is none.
size_t farthest_padded(const DefrayRaysParams p, const Rays* r, const size_t own) {
  size_t found = own;
  for (int y = -1; y <= 1; ++y) {
    for (int x = -2; x <= 2; ++x) {
      const size_t i = own + padded_layer(p) + (size_t)((long)y * p.stride + x);
      if (r->keys[i] == DEFRAY_NO_KEY) continue;
      if (found == own || r->keys[i] > r->keys[found]) found = i;
    }
  }
  return found;
}

void find_behind(const DefrayRaysParams p, const Rays* r, const Strip* s, Behind* b) {
  for (int j = 0; j < ROWS; ++j) {
    int there[16], was_seen[16], c0[16], c1[16], c2[16], c3[16];
    const size_t row = s->own + (size_t)j * p.stride;
    const bool is_row = s->y + j < (int)(p.window_y + p.window_rows);
    for (int i = 0; i < 16; ++i) {
      const bool is_inside = is_row && s->x + i < (int)p.width;
      const size_t at = is_inside ? farthest_padded(p, r, row + i) : row + i;
      there[i] = at == row + i ? 0 : -1;
      was_seen[i] = r->coverage[at] & DEFRAY_SYNTHESISED ? 0 : -1;
      c0[i] = as_int(r->channel0[at]);
      c1[i] = as_int(r->channel1[at]);
      c2[i] = as_int(r->channel2[at]);
      c3[i] = as_int(r->channel3[at]);
    }
    b->there[j] = vload16(0, there);
    b->was_seen[j] = vload16(0, was_seen);
    b->channel0[j] = vload16(0, c0);
    b->channel1[j] = vload16(0, c1);
    b->channel2[j] = vload16(0, c2);
    b->channel3[j] = vload16(0, c3);
  }
}

int16 passes_rim_at(const DefrayRaysParams p, const Strip* s, const int j, const int2 u,
                    __global const int* rim_x, __global const int* rim_y) {
  int passes[16];
  const int row = min(s->y + j, (int)(p.band_y + p.band_rows) - 1);
  for (int i = 0; i < 16; ++i) {
    passes[i] = passes_rim(u, rim_x[min(s->x + i, (int)p.width - 1)], rim_y[row]) ? -1 : 0;
  }
  return vload16(0, passes);
}

// Whether fragments send their rays to a cell: as `sends` in rdb_scatter.
int16 send_to(const uint16 sending, const uint cell) {
  return ((cell * 49471u + sending) & 0xffffu) <= sending >> 16u;
}

// The nearest of a row's fragments whose ray arrives, layer by layer.
typedef struct {
  int16 key, layer, was_seen, c0, c1, c2, c3;
} Nearest;

void look(const DefrayRaysParams p, const Rays* r, const size_t at, const int16 open,
          const int4 segment, const uint cell, Nearest* n) {
  n->key = DEFRAY_NO_KEY;
  for (uint layer = 0; layer < p.layers; ++layer) {
    const size_t from = at + layer * padded_layer(p);
    const int16 key = vload16(0, r->keys + from);
    int16 is = open & (key < n->key) &
               (as_uint16(key - segment.z) <= (uint16)(uint)segment.w);
    if (!any_of(is)) continue;
    if (p.has_coverage) is &= send_to(vload16(0, r->sending + from), cell);
    const int16 was_seen =
        p.has_coverage ? (as_int16(vload16(0, r->coverage + from)) >= 0) : (int16)(-1);
    n->key = (n->key & ~is) | (key & is);
    n->layer = (n->layer & ~is) | ((int16)(int)layer & is);
    n->was_seen = (n->was_seen & ~is) | (was_seen & is);
    n->c0 = (n->c0 & ~is) | (bits_at(r->channel0, from) & is);
    n->c1 = (n->c1 & ~is) | (bits_at(r->channel1, from) & is);
    n->c2 = (n->c2 & ~is) | (bits_at(r->channel2, from) & is);
    n->c3 = (n->c3 & ~is) | (bits_at(r->channel3, from) & is);
  }
}

// Winners of a row of a cell.
void write_winners(const DefrayRaysParams p, const Strip* s, const int j, const uint cell,
                   const uint16 source, const uint16 key, __global uint2* winner) {
  if (s->y + j >= (int)(p.band_y + p.band_rows)) return;
  uint sources[16], keys[16];
  vstore16(source, 0, sources);
  vstore16(key, 0, keys);
  const size_t to = ((size_t)cell * p.band_rows + (size_t)(s->y + j) - p.band_y) * p.width +
                    (size_t)s->x;
  for (int i = 0; i < 16 && s->x + i < (int)p.width; ++i) {
    winner[to + i] = (uint2)(sources[i], keys[i]);
  }
}

// Any surfaces: in layers, shares of pixels, made up; the rim; winners for others.
void gather_any(const DefrayRaysParams p, const Rays* r, const Runs* runs, Strip* s,
                __global const int2* lens, __global const int* rim_x, __global const int* rim_y,
                const bool wants_winners, __global uint2* winner) {
  const size_t stride = p.stride;
  const int16 lane = (int16)(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
  const bool has_behind = p.layers > 1u && p.has_coverage;
  Behind behind;
  if (has_behind) find_behind(p, r, s, &behind);
  for (uint k = 0; k < p.cells; ++k) {
    __global const int* first = r->first + k * (DEFRAY_RAY_BINS + 1);
    const int end_of_cell = first[DEFRAY_RAY_BINS];
    int16 open[ROWS], passes[ROWS], held[ROWS], held_key[ROWS];
    EACH_ROW {
      open[j] = s->inside[j];
      passes[j] = p.has_rim ? passes_rim_at(p, s, j, lens[k], rim_x, rim_y) : (int16)(-1);
      held[j] = held_key[j] = (int16)(-1);
    }
    bool is_open = true;
    int at = 0;
    for (int i = 0; i < runs->count && is_open; ++i) {
      const int end = min(first[runs->run[i].y] + 1, end_of_cell);
      for (at = max(at, first[runs->run[i].x]); at < end && is_open; ++at) {
        const int4 segment = r->segments[at];
        size_t from;
        if (!sources_of(p, s, segment, &from)) continue;
        int16 left = 0;
        for (int j = 0; j < ROWS; ++j) {
          Nearest n;
          look(p, r, from + j * stride, open[j], segment, k, &n);
          const int16 hit = n.key != DEFRAY_NO_KEY;
          if (any_of(hit)) {
            const int16 counts = hit & passes[j];
            add(s, r, j, counts, n.c0, n.c1, n.c2, n.c3, s->own + j * stride);
            s->seen[j] -= counts & n.was_seen;
            open[j] &= ~hit;
            if (wants_winners) {
              const int row = s->y + j - segment.y - (int)p.window_y;
              const int16 source =
                  (row * (int)p.layers + n.layer) * (int)p.width + (s->x - segment.x) + lane;
              held[j] = (held[j] & ~hit) | (source & hit);
              held_key[j] = (held_key[j] & ~hit) | ((n.key ^ (int16)(INT_MIN)) & hit);
            }
          }
          left |= open[j];
        }
        is_open = any_of(left);
      }
    }
    for (int j = 0; j < ROWS; ++j) {
      if (wants_winners) {
        write_winners(p, s, j, k, as_uint16(held[j]), as_uint16(held_key[j]), winner);
      }
      if (!has_behind) continue;
      const int16 counts = open[j] & behind.there[j] & passes[j];
      if (!any_of(counts)) continue;
      add(s, r, j, counts, behind.channel0[j], behind.channel1[j], behind.channel2[j],
          behind.channel3[j], s->own + j * stride);
      s->seen[j] -= counts & behind.was_seen[j];
    }
  }
}

// No ray leaves its pixel.
void keep(const DefrayRaysParams p, const Rays* r, Strip* s) {
  EACH_ROW {
    const int16 key = vload16(0, r->keys + s->own + (size_t)j * p.stride);
    s->seen[j] = (key != DEFRAY_NO_KEY) & (int16)(int)p.cells;
  }
}

void store(const DefrayRaysParams p, const Strip* s, const int j, const int16 bits,
           __global float* plane) {
  if (s->y + j >= (int)(p.band_y + p.band_rows)) return;
  const size_t to = (size_t)(s->y + j - (int)p.band_y) * p.width + (size_t)s->x;
  if (s->x + DEFRAY_RAY_RUN <= (int)p.width) {
    vstore16(as_float16(bits), 0, plane + to);
    return;
  }
  float values[16];
  vstore16(as_float16(bits), 0, values);
  for (int i = 0; s->x + i < (int)p.width; ++i) plane[to + i] = values[i];
}

int16 mean_of(const float16 total, const int16 count, const int16 differs, const int16 own) {
  const int16 mean = as_int16(total / convert_float16(max(count, 1)));
  const int16 is_mean = differs != 0;
  return (mean & is_mean) | (own & ~is_mean);
}

__kernel void rdb_gather(const DefrayRaysParams p, __global const int* restrict keys,
                         __global const uint* restrict sending,
                         __global const uint* restrict coverage, CHANNEL_PARAMETERS(channel),
                         __global const int4* restrict segments, __global const int* restrict first,
                         __global const ulong* restrict occupied,
                         __global const ulong* restrict sharp, __global const int2* restrict lens,
                         __global const int* restrict rim_x, __global const int* restrict rim_y,
                         __global const uint* restrict light_first, __global uint2* winner,
                         WRITTEN_CHANNELS(mean), __global uint* seen) {
  const int x = (int)(p.band_x + get_global_id(0) * DEFRAY_RAY_RUN);
  const int y = (int)(p.band_y + get_global_id(1) * DEFRAY_RAY_ROWS);
  if (x >= (int)p.band_end || y >= (int)(p.band_y + p.band_rows)) return;

  const Rays r = {keys,     sending,  coverage, channel0, channel1,
                  channel2, channel3, segments, first};
  Strip s;
  s.x = x;
  s.y = y;
  s.own = padded_at(p, x, y - (int)p.window_y);
  const int16 lane = (int16)(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
  EACH_ROW {
    s.inside[j] = y + j < (int)(p.band_y + p.band_rows) ? (lane + x) < (int)p.width : (int16)(0);
    s.total0[j] = s.total1[j] = s.total2[j] = s.total3[j] = (float16)(0.0f);
    s.differs[j] = s.count[j] = s.seen[j] = (int16)(0);
  }

  const uint tile = ((uint)y - p.window_y) / DEFRAY_RAY_TILE * p.tiles_x + (uint)x / DEFRAY_RAY_TILE;
  __global const ulong* plain = occupied + (size_t)tile * (2 * DEFRAY_RAY_WORDS);
  __global const ulong* special = plain + DEFRAY_RAY_WORDS;
  ulong is_special = 0ul, is_blurred = 0ul;
  for (int w = 0; w < DEFRAY_RAY_WORDS; ++w) {
    is_special |= special[w];
    is_blurred |= plain[w] & ~sharp[w];
  }
  const uint light_tile = (uint)y / DEFRAY_LIGHT_TILE * p.light_tiles_x + (uint)x / DEFRAY_LIGHT_TILE;
  const bool wants_winners =
      p.wants_winners == 2u ||
      (p.wants_winners == 1u && light_first[light_tile] < light_first[light_tile + 1u]);
  Runs runs;
  find_runs(plain, special, &runs);
  if (is_special != 0ul || p.has_rim || wants_winners) {
    gather_any(p, &r, &runs, &s, lens, rim_x, rim_y, wants_winners, winner);
  } else if (is_blurred != 0ul) {
    gather_plain(p, &r, &runs, &s);
    EACH_ROW s.seen[j] = s.count[j];
  } else {
    keep(p, &r, &s);
  }
  EACH_ROW {
    const size_t own = s.own + (size_t)j * p.stride;
    store(p, &s, j, mean_of(s.total0[j], s.count[j], s.differs[j], bits_at(channel0, own)), mean0);
    store(p, &s, j, mean_of(s.total1[j], s.count[j], s.differs[j], bits_at(channel1, own)), mean1);
    store(p, &s, j, mean_of(s.total2[j], s.count[j], s.differs[j], bits_at(channel2, own)), mean2);
    store(p, &s, j, mean_of(s.total3[j], s.count[j], s.differs[j], bits_at(channel3, own)), mean3);
    store(p, &s, j, s.seen[j], (__global float*)seen);
  }
}
