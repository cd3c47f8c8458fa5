#pragma once
// How a session's kernels are built and watched.
#include <string>
#include <vector>

#include "defray/device.h"
#include "opencl/kernel_source.h"

namespace defray {

struct SessionOptions {
  bool use_vectors = true;  ///< False: `rdb_gather` without them even where the device likes them.
  bool use_int64_atomics = true;  ///< False: the two-pass scatter even where the device has them.
  Math math = DeviceOptions().math;
  std::string build_options = {};  ///< More options for the OpenCL compiler.
  std::vector<Substitution> substitutions = {};
  std::vector<std::string> files = {};  ///< Names of the .cl files to build; empty: all.
  bool measures = false;                ///< Keep each kernel's time on the device.
};

}  // namespace defray
