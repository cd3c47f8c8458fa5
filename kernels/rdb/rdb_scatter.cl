// rdb_scatter: sends every source pixel's rays into the ray distribution buffers (RDBs).
//
// Source pixel p with signed CoC radius r reaches cell k of target pixel x exactly when
// x - p - r u_k lies in [-1/2, 1/2)^2, r as landing_radii has it (Shinya 1994, section 4, step 4
// and figure 6: the square is the quadrilateral s0..s3, seen from the lens). The cell keeps the
// nearest source, that of the smallest signed radius: it grows with depth. Equal radii go to the
// smaller source index (without jitter only those of one pixel meet), so the result does not depend
// on the order of arrival. All arithmetic is on integers: the same cells win on every device.
//
// With spans a fragment reaches the cells of all radii that it spans, as the least of those that
// end there.
//
// A pixel may hold several fragments. One that covers only a share of its pixel sends that share of
// its rays, spread evenly over the lens.
//
// coc_quanta  [window_rows][layers][width]      signed radius, 1/256 px
// depth_bits  [window_rows][layers][width]      all ones where there is no fragment
// coverage    [window_rows][layers][width]      2^-16 of the pixel, bit 31 apart; if has_coverage
// lens        [cells]                           u_k, 2^-16 of the aperture radius
// landing_radii [DEFRAY_SMALL_QUANTA]  of radii below 1 px the ones as which rays land, 1/256 px
//                                      (host/lens/landing_radii.h); if has_landing_radii
// winner      [cell_count][band_rows][width]    (x: source index in the window, y: key, the
//                                               radius + 2^31),
//                                               all ones where no ray has arrived
//
// rdb_clear empties the cells before it. Global size: (cells of the pass).
//
// Build with -DDEFRAY_INT64_ATOMICS where the device has cl_khr_int64_extended_atomics: the pair
// is then one 64-bit minimum. Elsewhere the kernel runs twice: minimum of the keys, then minimum
// of the indices that have this key. Global size: (width, window_rows x layers,
// cell_count).
#include "base/colour.clh"
#include "base/pcg3d.clh"
#include "rdb/span.clh"

#ifdef DEFRAY_INT64_ATOMICS
#pragma OPENCL EXTENSION cl_khr_int64_base_atomics : enable
#pragma OPENCL EXTENSION cl_khr_int64_extended_atomics : enable
#endif

#define RAY_FRACTION_BITS (DEFRAY_COC_FRACTION_BITS + DEFRAY_LENS_FRACTION_BITS)
#define HALF_PIXEL (1L << (RAY_FRACTION_BITS - 1))

// The one d with d - offset in [-1/2, 1/2): where a ray with this offset lands, in whole pixels.
int landing(const long offset) { return (int)((offset + HALF_PIXEL - 1) >> RAY_FRACTION_BITS); }

// The radius as which rays of this one land. (A restrict here is inlined into what Oclgrind lacks.)
int landing_radius(const DefrayRdbParams p, __global const int* landing_radii, const int radius) {
  const uint size = abs(radius);
  if (!p.has_landing_radii || size >= DEFRAY_SMALL_QUANTA) return radius;
  return radius < 0 ? -landing_radii[size] : landing_radii[size];
}

// Where rays of a radius end, in whole pixels from where they begin.
int2 lands_at(const DefrayRdbParams p, __global const int* landing_radii, const long2 u,
              const int radius) {
  const long r = landing_radius(p, landing_radii, radius);
  return (int2)(landing(r * u.x), landing(r * u.y));
}

// Jitter of a target pixel's lens points, in [-largest, largest)^2: a hash of absolute frame
// coordinates, so that no tile or band shows.
int2 jitter_offset(const uint x, const uint y, const uint seed, const int largest) {
  const uint3 v = pcg3d((uint3)(x, y, seed));
  const uint range = 2u * (uint)largest;
  return (int2)((int)mul_hi(v.x, range) - largest, (int)mul_hi(v.y, range) - largest);
}

// Whether a fragment sends its ray to a cell: an even share of them, as Kronecker sequences give it
// (the factor is 2^16 / 1.3247..., the plastic number: no relation to the spiral's golden angle).
bool sends(const uint coverage, const uint cell, const uint x, const uint y) {
  const uint turn = pcg3d((uint3)(x, y, 0u)).z;
  return ((cell * 49471u + turn) & 0xffffu) < (coverage & ~DEFRAY_SYNTHESISED);
}

// Whether jittered cell u of pixel x is hit from pixel p: its sample may have left the aperture.
bool arrives(const int2 x, const int2 p, const int2 origin, const long r, const long2 u,
             const uint seed, const int jitter) {
  const uint2 at = as_uint2(x + origin);
  const long2 v = u + convert_long2(jitter_offset(at.x, at.y, seed, jitter));
  return v.x * v.x + v.y * v.y <= 1L << (2 * DEFRAY_LENS_FRACTION_BITS) &&
         landing(r * v.x) == x.x - p.x && landing(r * v.y) == x.y - p.y;
}

// Keys grow with depth.
uint key_of(const int radius) { return as_uint(radius) ^ 0x80000000u; }

void deposit(__global uint2* winner, const size_t slot, const uint key, const uint source,
             const uint is_index_pass) {
#ifdef DEFRAY_INT64_ATOMICS
  (void)is_index_pass;
  atom_min((volatile __global ulong*)(winner + slot), ((ulong)key << 32) | source);
#else
  volatile __global uint* half_keys = (volatile __global uint*)(winner + slot);
  if (!is_index_pass) {
    atomic_min(half_keys + 1, key);
  } else if (half_keys[1] == key) {
    atomic_min(half_keys, source);
  }
#endif
}

// The first radius after `from`, up to `last`, whose ray ends elsewhere; last + 1: none.
int next_elsewhere(const DefrayRdbParams p, __global const int* landing_radii, const long2 u,
                   const int from, const int last) {
  const int2 here = lands_at(p, landing_radii, u, from);
  if (all(lands_at(p, landing_radii, u, last) == here)) return last + 1;
  int same = from, other = last;
  while (other - same > 1) {
    const int between = same + (other - same) / 2;
    if (all(lands_at(p, landing_radii, u, between) == here)) {
      same = between;
    } else {
      other = between;
    }
  }
  return other;
}

__kernel void rdb_clear(const DefrayRdbParams p, __global uint2* winner) {
  const size_t i = get_global_id(0);
  if (i >= (size_t)p.cell_count * p.band_rows * p.width) return;
  winner[i] = (uint2)(DEFRAY_EMPTY);
}

__kernel void rdb_scatter(const DefrayRdbParams p, __global const int* restrict coc_quanta,
                          __global const uint* restrict depth_bits,
                          __global const uint* restrict coverage,
                          __global const int2* restrict lens,
                          __global const int* restrict landing_radii, __global uint2* winner) {
  const uint sx = get_global_id(0);
  const uint row = get_global_id(1);
  const uint cell = get_global_id(2);
  if (sx >= p.width || row >= p.window_rows * p.layers || cell >= p.cell_count) return;

  const uint source = row * p.width + sx;
  if (depth_bits[source] == DEFRAY_EMPTY) return;
  const int radius = coc_quanta[source];
  const long2 u = convert_long2(lens[p.first_cell + cell]);
  const int2 from = (int2)((int)sx, (int)(p.window_y + row / p.layers));
  const int2 origin = (int2)(p.origin_x, p.origin_y);
  const uint2 at = as_uint2(from + origin);
  if (p.has_coverage && !sends(coverage[source], p.first_cell + cell, at.x, at.y)) return;
  const int2 first = (int2)(0, (int)p.band_y);
  const int2 last = (int2)((int)p.width, (int)(p.band_y + p.band_rows)) - 1;
  const size_t slot = (size_t)cell * p.band_rows * p.width;  // of the band's first pixel

  if (p.jitter_lens == 0) {
    int2 span = (int2)(radius);
    if (p.has_spans) {
      const Fragments all = {coc_quanta, depth_bits, p.width, p.layers, p.window_rows};
      span = span_of(all, (int3)((int)sx, (int)(row / p.layers), (int)(row % p.layers)));
    }
    for (int r = span.x; r <= span.y; r = next_elsewhere(p, landing_radii, u, r, span.y)) {
      const int2 to = from + lands_at(p, landing_radii, u, r) - first;
      if (any(to < 0) || any(to > last - first)) continue;
      deposit(winner, slot + (size_t)to.y * p.width + (uint)to.x, key_of(r), source,
              p.is_index_pass);
    }
    return;
  }

  const long r = landing_radius(p, landing_radii, radius);
  const long spread = (long)abs(radius) * p.jitter_lens;  // in int: Mesa 22.3 gets |long| wrong
  const int2 low = from + (int2)(landing(r * u.x - spread), landing(r * u.y - spread));
  const int2 high = from + (int2)(landing(r * u.x + spread), landing(r * u.y + spread));
  for (int y = max(low.y, first.y); y <= min(high.y, last.y); ++y) {
    for (int x = max(low.x, 0); x <= min(high.x, last.x); ++x) {
      if (arrives((int2)(x, y), from, origin, r, u, p.seed, p.jitter_lens)) {
        deposit(winner, slot + (size_t)(y - first.y) * p.width + (uint)x, key_of(radius), source,
                p.is_index_pass);
      }
    }
  }
}
