#include "splats/splat_naive.h"

#include <algorithm>
#include <string>

#include "base/error.h"
#include "opencl/kernel_source.h"

namespace defray::perf {
namespace {

constexpr const char* source = R"CLC(
#pragma OPENCL FP_CONTRACT OFF  // a weight that is just 0 for one and not the other decides what meets
#define MOST 512

__kernel void rasterise(const DefraySplatParams p, __global const DefraySplat* splats,
                        __global const DefraySplatLine* lines,
                        __global int* heads, __global int* next, __global int* splat_of,
                        __global float* weights, __global int* count) {
  const int i = get_global_id(0);
  if (i >= (int)p.count) return;
  const DefraySplat s = splats[i];
  for (int y = s.first_y; y < s.end_y; ++y) {
    for (int x = s.first_x; x < s.end_x; ++x) {
      const float dx = x + 0.5f - s.x, dy = y + 0.5f - s.y;
      const float form = (s.conic_xx * dx + 2.0f * s.conic_xy * dy) * dx + s.conic_yy * dy * dy;
      const float left = clamp(s.disc_top - form, 0.0f, 1.0f);
      const float leant = s.amplitude + s.lean_x * dx + s.lean_y * dy;
      float before = 1.0f;
      for (int k = 0; k < (s.lines != 0 ? DEFRAY_SPLAT_RIDGES : 0); ++k) {
        const DefraySplatLine line = lines[s.lines * DEFRAY_SPLAT_RIDGES + k];
        before = fmin(before, fmax(line.at + line.x * dx + line.y * dy, line.least));
      }
      const float weight = fmax(s.back * leant, leant) * before *
                           (s.disc_top > 0.0f ? left * left * (1.0f + s.disc_bulge * (1.0f - left))
                                              : form < p.cutoff ? exp(-form) - p.edge : 0.0f);
      if (!(weight > 0.0f)) continue;
      const int at = atomic_inc(count);
      weights[at] = weight;
      splat_of[at] = i;
      next[at] = atomic_xchg(heads + y * (int)p.width + x, at);
    }
  }
}

__kernel void resolve(const DefraySplatParams p, __global const DefraySplat* splats,
                      __global const int* heads, __global const int* next,
                      __global const int* splat_of, __global const float* weights,
                      __global float4* out, __global int* too_many) {
  const int pixel = get_global_id(0);
  if (pixel >= (int)(p.width * p.height)) return;
  int fragments[MOST], count = 0;
  for (int at = heads[pixel]; at >= 0; at = next[at]) {
    if (count == MOST) {
      *too_many = 1;
      break;
    }
    int k = count++;
    for (; k > 0 && splat_of[fragments[k - 1]] > splat_of[at]; --k) fragments[k] = fragments[k - 1];
    fragments[k] = at;
  }
  float4 sum = 0.0f, layer = 0.0f;
  float weight = 0.0f, far = -INFINITY;
  for (int k = 0; k < count; ++k) {
    const DefraySplat s = splats[splat_of[fragments[k]]];
    if (s.z_near > far) {
      sum += (1.0f - sum.w) * layer;
      layer = 0.0f;
      weight = 0.0f;
    }
    far = fmax(far, s.z_far);
    const float taken = fmin(weights[fragments[k]], 1.0f - weight);
    weight += taken;
    layer += taken * (float4)(s.r, s.g, s.b, s.a);
  }
  out[pixel] = sum + (1.0f - sum.w) * layer;
}
)CLC";

/// Upper bound of the fragments: all boxes.
std::size_t fragments_of(const Values<DefraySplat>& splats) {
  std::size_t count = 1;
  for (const DefraySplat& s : splats) {
    count += size(s.end_x - s.first_x) * size(s.end_y - s.first_y);
  }
  return count;
}

double event_seconds(const cl::Event& event) {
  return 1e-9 * static_cast<double>(event.getProfilingInfo<CL_PROFILING_COMMAND_END>() -
                                    event.getProfilingInfo<CL_PROFILING_COMMAND_START>());
}

}  // namespace

NaiveSplats::NaiveSplats(const DeviceInfo& info)
    : context_(info.device),
      queue_(context_, info.device, CL_QUEUE_PROFILING_ENABLE),
      program_(context_, kernel_source({"splat/splat_project.cl"}, {}) + source, true) {}

std::vector<Plane> NaiveSplats::draw(const Splats& given, const DefraySplatParams& params,
                                     int repetitions, double& seconds) {
  const Values<DefraySplat>& splats = given.all;
  DefraySplatParams p = params;
  p.count = static_cast<std::uint32_t>(splats.size());
  const std::size_t pixels = std::size_t{p.width} * p.height, most = fragments_of(splats);
  const auto buffer = [&](std::size_t bytes) {
    return cl::Buffer(context_, CL_MEM_READ_WRITE, bytes);
  };
  const cl::Buffer in(context_, CL_MEM_READ_ONLY | CL_MEM_COPY_HOST_PTR,
                      splats.size() * sizeof(DefraySplat),
                      const_cast<DefraySplat*>(splats.begin()));
  const cl::Buffer lines(context_, CL_MEM_READ_ONLY | CL_MEM_COPY_HOST_PTR,
                         given.lines.size() * sizeof(DefraySplatLine),
                         const_cast<DefraySplatLine*>(given.lines.begin()));
  const cl::Buffer heads = buffer(pixels * 4), next = buffer(most * 4), splat_of = buffer(most * 4);
  const cl::Buffer weights = buffer(most * 4), out = buffer(pixels * 16), count = buffer(4);
  cl::Kernel rasterise(program_, "rasterise"), resolve(program_, "resolve");
  const auto set = [](cl::Kernel& kernel, const auto&... args) {
    cl_uint index = 0;
    (kernel.setArg(index++, args), ...);
  };
  set(rasterise, p, in, lines, heads, next, splat_of, weights, count);
  set(resolve, p, in, heads, next, splat_of, weights, out, count);
  for (int i = 0; i <= repetitions; ++i) {  // one more: to warm up
    queue_.enqueueFillBuffer(heads, cl_int{-1}, 0, pixels * 4);
    queue_.enqueueFillBuffer(count, cl_int{0}, 0, 4);
    cl::Event first, second;
    const auto items = [](std::size_t n) { return cl::NDRange((n + 63) / 64 * 64); };
    queue_.enqueueNDRangeKernel(rasterise, cl::NullRange, items(splats.size()), cl::NDRange(64),
                                nullptr, &first);
    queue_.enqueueFillBuffer(count, cl_int{0}, 0, 4);
    queue_.enqueueNDRangeKernel(resolve, cl::NullRange, items(pixels), cl::NDRange(64), nullptr,
                                &second);
    queue_.finish();
    const double took = event_seconds(first) + event_seconds(second);
    seconds = i < 2 ? took : std::min(seconds, took);
  }
  cl_int too_many = 0;
  queue_.enqueueReadBuffer(count, CL_TRUE, 0, 4, &too_many);
  if (too_many) fail(ErrorKind::internal, "a pixel has more fragments than the naive splats take");
  std::vector<cl_float4> made(pixels);
  queue_.enqueueReadBuffer(out, CL_TRUE, 0, pixels * 16, made.data());
  std::vector<Plane> planes(4, Plane(pixels));
  for (std::size_t c = 0; c < 4; ++c) {
    for (std::size_t k = 0; k < pixels; ++k) planes[c][k] = made[k].s[c];
  }
  return planes;
}

}  // namespace defray::perf
