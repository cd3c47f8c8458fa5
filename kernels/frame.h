// Pixels of a whole frame.
#ifndef DEFRAY_KERNELS_FRAME_H
#define DEFRAY_KERNELS_FRAME_H
#include "params.h"

// Index of a pixel; beyond the frame that of the nearest in it.
uint pixel_at(const uint width, const uint height, const int2 at) {
  const uint x = (uint)clamp(at.x, 0, (int)width - 1), y = (uint)clamp(at.y, 0, (int)height - 1);
  return y * width + x;
}

// A pixel's CoC, limited so that differences stay in range: what is beyond has left every frame.
int coc_of(__global const int* restrict coc_quanta, const uint pixel) {
  return clamp(coc_quanta[pixel], -DEFRAY_TAME_QUANTA, DEFRAY_TAME_QUANTA);
}

// Direction i of 16: (cos, sin) of i / 16 of a turn.
float2 sixteenth(const uint i) {
  const float c[5] = {1.0f, 0.923879533f, 0.707106781f, 0.382683432f, 0.0f};
  const uint quarter = i / 4u, part = i % 4u;
  const float2 d = (float2)(c[part], c[4u - part]);
  const float2 turned = quarter % 2u ? (float2)(-d.y, d.x) : d;
  return quarter < 2u ? turned : -turned;
}

#endif
