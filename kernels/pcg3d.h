// A hash of three words (Jarzynski & Olano, "Hash functions for GPU rendering", 2020).
#ifndef DEFRAY_KERNELS_PCG3D_H
#define DEFRAY_KERNELS_PCG3D_H

uint3 pcg3d(uint3 v) {
  v = v * 1664525u + 1013904223u;
  v.x += v.y * v.z;
  v.y += v.z * v.x;
  v.z += v.x * v.y;
  v ^= v >> 16u;
  v.x += v.y * v.z;
  v.y += v.z * v.x;
  v.z += v.x * v.y;
  return v;
}

#endif
