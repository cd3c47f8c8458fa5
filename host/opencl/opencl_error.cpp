#include "opencl/opencl_error.h"

#include <algorithm>
#include <iterator>

namespace defray {

namespace {

struct Name {
  int code;
  const char* name;
};

#define DEFRAY_NAME(name) \
  Name { name, #name }
constexpr Name error_names[] = {
    DEFRAY_NAME(CL_DEVICE_NOT_FOUND),       DEFRAY_NAME(CL_DEVICE_NOT_AVAILABLE),
    DEFRAY_NAME(CL_COMPILER_NOT_AVAILABLE), DEFRAY_NAME(CL_MEM_OBJECT_ALLOCATION_FAILURE),
    DEFRAY_NAME(CL_OUT_OF_RESOURCES),       DEFRAY_NAME(CL_OUT_OF_HOST_MEMORY),
    DEFRAY_NAME(CL_BUILD_PROGRAM_FAILURE),  DEFRAY_NAME(CL_INVALID_VALUE),
    DEFRAY_NAME(CL_INVALID_DEVICE),         DEFRAY_NAME(CL_INVALID_BUFFER_SIZE),
    DEFRAY_NAME(CL_INVALID_BUILD_OPTIONS),  DEFRAY_NAME(CL_INVALID_KERNEL_NAME),
    DEFRAY_NAME(CL_INVALID_KERNEL_ARGS),    DEFRAY_NAME(CL_INVALID_ARG_INDEX),
    DEFRAY_NAME(CL_INVALID_ARG_SIZE),       DEFRAY_NAME(CL_INVALID_WORK_GROUP_SIZE),
    DEFRAY_NAME(CL_INVALID_WORK_ITEM_SIZE), DEFRAY_NAME(CL_INVALID_HOST_PTR)};
#undef DEFRAY_NAME

}  // namespace

std::string opencl_error_name(int code) {
  const auto* const found = std::find_if(std::begin(error_names), std::end(error_names),
                                         [&](const Name& n) { return n.code == code; });
  return found == std::end(error_names) ? fmt::format("OpenCL error {}", code) : found->name;
}

}  // namespace defray
