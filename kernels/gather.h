// What the gather kernels share: the turn of a pixel's sample set.
#ifndef DEFRAY_KERNELS_GATHER_H
#define DEFRAY_KERNELS_GATHER_H
#include "colour.h"
#include "params.h"
#include "pcg3d.h"

// The turn (cos, sin) of a pixel's sample set, from a table: no device's sine matters.
float2 gather_turn(const DefrayGatherParams p, __global const float2* restrict rotations,
                   const uint x, const uint y) {
  if (!p.rotates) return (float2)(1.0f, 0.0f);
  return rotations[pcg3d((uint3)(x, y, p.seed)).x % DEFRAY_GATHER_ROTATIONS];
}

float2 rotated(const float2 v, const float2 turn) {
  return (float2)(v.x * turn.x - v.y * turn.y, v.x * turn.y + v.y * turn.x);
}

#endif
