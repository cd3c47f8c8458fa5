// rdb_gather: what rdb_scatter and rdb_merge compute, bit for bit, from where the rays end.
//
// Through one lens point u a radius r lands at the offset landing(r u), which changes at known
// radii: the segments (dx, dy, least radius, span), the same for all pixels. In a segment a target
// sees one source pixel, (dx, dy) before it, and its ray arrives exactly if its radius, or one that
// it spans, is in the segment. Segments come in ascending radius: what arrives first is the
// nearest, and the cell is done. No winners are stored and none is compared. Cells are added in the
// lens's order, as rdb_merge adds them: the same sums.
//
// A tile's bins say which radii there are within reach; only segments that meet them are looked at.
// Where others than plain surfaces are within reach, each segment's sources are asked whether they
// may be such; plain ones go the short way (find_hits, add_hits).
// The cells come in passes: some devices end a kernel's loops after so many turns, or a kernel
// after so many seconds.
//
// keys, largest, sending, coverage, channel0..3   padded planes of the window, from rdb_pad
// segments        of the pass, in the order of cells, radii ascending within each
// first           [cells of the pass][bins + 1]  the first segment that reaches into a bin; last of
//                                    a cell: one past its own
// occupied        [tiles][2][words]  from rdb_reach
// special_rows    [tiles]            from rdb_tiles
// sparsity        [tiles]            0: rays of all rows, 1: of half, 2: of a quarter (sparse.clh)
// sharp           [words]            bins whose rays end where they begin, whatever the lens point
// lens, rim_x, rim_y                 as in rdb_merge
// winner          [cells][band_rows][width]  source in the window, all ones where no ray has
// arrived;
//                                    where rdb_nearest asks for it
// sum0..3         [band_rows][width] colours' sums; after the last pass the means
// filled, seen    [band_rows][width] as in rdb_merge
// Global size: strips of DEFRAY_RAY_RUN x DEFRAY_RAY_ROWS targets, or targets (lanes.clh).
#include "rdb/rdb_gather_any.clh"
#include "rdb/strip.clh"

// One whole surface a pixel, all of it seen, no rim, nobody asks for winners. Inlined for three and
// for four channels: a quarter less to load and add.
INLINED void gather_plain(const DefrayRaysParams p, const Rays* r, const Runs* runs,
                          const bool has_fourth, Strip* s) {
  for (uint k = 0; k < p.cell_count; ++k) {
    __global const int* first = r->first + k * (DEFRAY_RAY_BINS + 1);
    const int end_of_cell = first[DEFRAY_RAY_BINS];
    ints open[ROWS];
    EACH_ROW open[j] = s->inside[j];
    bool is_open = true;
    int at = 0;
    for (int i = 0; i < runs->count && is_open; ++i) {
      const int end = min(first[runs->run[i].y] + 1, end_of_cell);
      for (at = max(at, first[runs->run[i].x]); at < end && is_open; ++at) {
        const int4 segment = r->segments[at];
        size_t from;
        if (!sources_of(p, s, segment, &from)) continue;
        ints hit[ROWS];
        if (!find_hits(p, r, s, from, segment, open, hit)) continue;
        add_hits(p, r, has_fourth, from, hit, s);
        is_open = close_hit(open, hit);
      }
    }
    find_whether_all_differ(s);
  }
}

// No ray leaves its pixel.
void keep(const DefrayRaysParams p, const Rays* r, Strip* s) {
  EACH_ROW {
    const ints key = LOAD(r->keys + s->own + (size_t)s->row[j] * p.stride);
    s->seen[j] += IS(key != DEFRAY_NO_KEY) & (ints)(int)p.cell_count;
  }
}

__kernel void rdb_gather(const DefrayRaysParams p, __global const int* restrict keys,
                         __global const int* restrict largest,
                         __global const uint* restrict sending,
                         __global const uint* restrict coverage, CHANNEL_PARAMETERS(channel),
                         __global const int4* restrict segments, __global const int* restrict first,
                         __global const ulong* restrict occupied,
                         __global const ulong* restrict sharp,
                         __global const uint* restrict special_rows,
                         __global const uint* restrict sparsity, __global const int2* restrict lens,
                         __global const int* restrict rim_x, __global const int* restrict rim_y,
                         __global uint* winner, WRITTEN_CHANNELS(sum), __global uint* filled,
                         __global uint* seen) {
  const int x = (int)(p.band_x + get_global_id(0) * LANES);
  const int y = (int)(p.band_y + get_global_id(1) * ROWS);
  if (x >= (int)p.band_end || y >= (int)(p.band_y + p.band_rows)) return;

  const Rays r = {keys,        p.has_spans ? largest : keys,
                  sending,     coverage,
                  channel0,    channel1,
                  channel2,    channel3,
                  segments,    first,
                  special_rows};
  const uint tile = tile_at(p, x, y);
  Strip s;
  if (!place(p, x, y, sparsity[tile], &s)) return;
  begin(p, sum0, sum1, sum2, sum3, filled, seen, &s);

  __global const ulong* plain = occupied + (size_t)tile * (2 * DEFRAY_RAY_WORDS);
  __global const ulong* special = plain + DEFRAY_RAY_WORDS;
  ulong is_special = 0ul, is_blurred = 0ul;
  for (int w = 0; w < DEFRAY_RAY_WORDS; ++w) {
    is_special |= special[w];
    is_blurred |= plain[w] & ~sharp[w];
  }
  Runs runs;
  find_runs(plain, special, &runs);
  if (is_special != 0ul || p.has_rim || p.wants_winners) {
    gather_any(p, &r, &runs, &s, lens, rim_x, rim_y, p.wants_winners, winner);
  } else if (is_blurred != 0ul) {
    EACH_ROW s.seen[j] -= s.count[j];  // what this pass counts was seen
    if (p.channels > 3u) {
      gather_plain(p, &r, &runs, true, &s);
    } else {
      gather_plain(p, &r, &runs, false, &s);
    }
    EACH_ROW s.seen[j] += s.count[j];
  } else {
    keep(p, &r, &s);
  }
  end(p, &r, &s, sum0, sum1, sum2, sum3, filled, seen);
}
