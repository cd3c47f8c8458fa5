#include "opencl/program.h"

#include <algorithm>
#include <chrono>
#include <thread>

#include "opencl/kernel_cache.h"
#include "opencl/opencl_error.h"

namespace defray {
namespace {

std::string build_log(const cl::Program& program, const cl::Device& device) {
  try {
    return program.getBuildInfo<CL_PROGRAM_BUILD_LOG>(device);
  } catch (const cl::Error&) {
    return "";
  }
}

/// A compile error has a log; where other programs fill PoCL's cache at the same time it is empty,
/// or its last sentence alone.
bool is_compile_error(std::string log) {
  const std::size_t begin = log.find("Device "), end = log.find(" failed to build the program");
  if (begin < end && end != std::string::npos) log.erase(begin, log.find('\n', end) - begin);
  return log.find_first_not_of(" \n\t") != std::string::npos;
}

/// PoCL 3.1 loses a race when several processes fill a cold kernel cache: clBuildProgram fails, and
/// a new program succeeds, on a busy machine seconds later. Ours wait for each other; other
/// programs may be at it as well. A compile error is one at once.
cl::Program compiled(const cl::Context& context, const DeviceInfo& info, const std::string& source,
                     const std::string& options) {
  constexpr int attempts = 16;
  const KernelCacheLock lock;
  for (int attempt = 1;; ++attempt) {
    cl::Program program(context, source);
    try {
      program.build({info.device}, options.c_str());
      return program;
    } catch (const cl::Error& error) {
      const std::string log = build_log(program, info.device);
      if (is_compile_error(log) || attempt == attempts) {
        fail(ErrorKind::device, "clBuildProgram failed on {}: {} (options: {})\n{}", info.name,
             opencl_error_name(error.err()), options, with_places(log, source));
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(std::min(50 * attempt, 500)));
    }
  }
}

std::string build_options(const DeviceInfo& info, const SessionOptions& options,
                          bool int64_atomics) {
  // Warnings are for those who build defray (kernels/CMakeLists.txt); of clang's of float16 without
  // AVX-512 PoCL would print "483 warnings generated." on a user's first run.
  std::string text = "-cl-std=CL1.2 -w " + options.build_options;
  if (int64_atomics) text += " -DDEFRAY_INT64_ATOMICS";
  if (!options.use_vectors || !info.prefers_vectors) text += " -DDEFRAY_SCALARS";
  if (options.math == Math::fast) return text + " -DDEFRAY_FAST_MATH -cl-fast-relaxed-math";
  // Without it OpenCL lets x / y be 2.5 ulp off, and sqrt 3.
  if (info.rounds_divisions) text += " -cl-fp32-correctly-rounded-divide-sqrt";
  return text;
}

}  // namespace

cl::Program build_program(const cl::Context& context, const DeviceInfo& info,
                          const SessionOptions& options, bool int64_atomics) {
  const std::string source = kernel_source(options.files, options.substitutions);
  return checked(info, "clCreateProgramWithSource", [&] {
    return compiled(context, info, source, build_options(info, options, int64_atomics));
  });
}

}  // namespace defray
