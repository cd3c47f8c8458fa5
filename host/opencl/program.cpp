#include "opencl/program.h"

#include <algorithm>
#include <chrono>
#include <thread>

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

/// PoCL 3.1 loses a race when several processes fill a cold kernel cache: clBuildProgram fails
/// with an empty log, and a new program succeeds, on a busy machine seconds later (of 48 processes
/// on 2 cores one found 1.4 s too short). A real compile error has a log: no second try.
cl::Program compiled(const cl::Context& context, const DeviceInfo& info, const std::string& source,
                     const std::string& options) {
  constexpr int attempts = 16;
  for (int attempt = 1;; ++attempt) {
    cl::Program program(context, source);
    try {
      program.build({info.device}, options.c_str());
      return program;
    } catch (const cl::Error& error) {
      const std::string log = build_log(program, info.device);
      const bool is_real = log.find_first_not_of(" \n\t") != std::string::npos;
      if (is_real || attempt == attempts) {
        fail(ErrorKind::device, "clBuildProgram failed on {}: {} (options: {})\n{}", info.name,
             opencl_error_name(error.err()), options, log);
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(std::min(50 * attempt, 500)));
    }
  }
}

std::string build_options(const DeviceInfo& info, const SessionOptions& options,
                          bool int64_atomics) {
  std::string text = "-cl-std=CL1.2 " + options.build_options;
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
