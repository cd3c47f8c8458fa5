// A pixel's four channels, and its depth.
#ifndef DEFRAY_KERNELS_COLOUR_H
#define DEFRAY_KERNELS_COLOUR_H

float4 colour_at(__global const float* restrict channel0, __global const float* restrict channel1,
                 __global const float* restrict channel2, __global const float* restrict channel3,
                 const size_t at) {
  return (float4)(channel0[at], channel1[at], channel2[at], channel3[at]);
}

// Depth as uint: positive floats compare like their bits.
uint depth_at(__global const uint* restrict depth_bits, const size_t at) { return depth_bits[at]; }

#endif
