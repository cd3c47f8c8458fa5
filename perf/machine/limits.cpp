#include "machine/limits.h"

#include <algorithm>
#include <vector>

#include "base/error.h"

namespace defray::perf {
namespace {

constexpr const char* source = R"CLC(
__kernel void copy(__global const float16* restrict from, __global float16* restrict to) {
  const size_t i = get_global_id(0);
  to[i] = from[i];
}

__kernel void test(__global int16* restrict out, const int turns, const int step) {
  int16 key[4], hits[4];
  for (int j = 0; j < 4; ++j) key[j] = out[4 * get_global_id(0) + j], hits[j] = 0;
  for (int i = 0; i < turns; ++i) {
    for (int j = 0; j < 4; ++j) hits[j] |= as_int16(as_uint16(key[j] - i * step) <= (uint16)(7u));
  }
  for (int j = 0; j < 4; ++j) out[4 * get_global_id(0) + j] = hits[j];
}
)CLC";

/// One device with the two kernels.
class Probe {
 public:
  explicit Probe(const DeviceInfo& info)
      : context_(info.device),
        queue_(context_, info.device, CL_QUEUE_PROFILING_ENABLE),
        program_(context_, source, true) {}

  cl::Buffer buffer(std::size_t bytes) {
    const cl::Buffer made(context_, CL_MEM_READ_WRITE, bytes);
    queue_.enqueueFillBuffer(made, cl_int{0}, 0, bytes);
    return made;
  }

  template <typename... Args>
  double seconds(const char* name, std::size_t items, int repetitions, const Args&... args) {
    cl::Kernel kernel(program_, name);
    cl_uint index = 0;
    (kernel.setArg(index++, args), ...);
    double best = 0;
    for (int i = 0; i <= repetitions; ++i) {  // one more: to warm up
      cl::Event event;
      queue_.enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(items), cl::NDRange(64),
                                  nullptr, &event);
      queue_.finish();
      const auto start = event.getProfilingInfo<CL_PROFILING_COMMAND_START>();
      const double took =
          1e-9 * static_cast<double>(event.getProfilingInfo<CL_PROFILING_COMMAND_END>() - start);
      best = i < 2 ? took : std::min(best, took);
    }
    return best;
  }

 private:
  cl::Context context_;
  cl::CommandQueue queue_;
  cl::Program program_;
};

}  // namespace

Limits measure_limits(const DeviceInfo& info, int repetitions) {
  try {
    Probe probe(info);
    constexpr std::size_t bytes = std::size_t{1} << 28, vector = 64;
    const cl::Buffer from = probe.buffer(bytes), to = probe.buffer(bytes);
    const double copying = probe.seconds("copy", bytes / vector, repetitions, from, to);
    constexpr std::size_t items = 4096, lanes = 4 * 16;
    constexpr cl_int turns = 4096, step = 3;
    const cl::Buffer keys = probe.buffer(items * lanes * sizeof(cl_int));
    const double testing = probe.seconds("test", items, repetitions, keys, turns, step);
    return {2.0 * bytes / copying, double{turns} * items * lanes / testing};
  } catch (const cl::Error& error) {
    fail(ErrorKind::device, "{} failed on {}: {}", error.what(), info.name, error.err());
  }
}

}  // namespace defray::perf
