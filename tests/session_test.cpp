// OpenCL errors say what failed, where and why.
#include "opencl/session.h"

#include "support.h"

namespace defray::test {
namespace {

TEST(Session, AnUnknownKernelIsNamed) {
  expect_error(5, {"clCreateKernel nonesuch", "CL_INVALID_KERNEL_NAME", session().info().name},
               [] { session().launch("nonesuch", 1, {1}); });
}

TEST(Session, BuffersBeyondTheDevicesLimitAreRefused) {
  const std::size_t too_much = session().info().max_buffer_bytes + 1;
  expect_error(5, {"allows at most", "--memory"}, [&] { session().buffer(too_much); });
  const char byte = 0;
  expect_error(5, {"allows at most", "--max-coc"}, [&] { session().view(&byte, too_much); });
}

TEST(Session, WorkGroupsBeyondTheDevicesLimitAreRefused) {
  Session own(device_under_test());
  expect_error(2, {"work-items", "allows at most"},
               [&] { own.set_work_group(own.info().max_work_group, 2); });
}

TEST(Session, ErrorNames) {
  EXPECT_EQ(opencl_error_name(-30), "CL_INVALID_VALUE");
  EXPECT_EQ(opencl_error_name(-9999), "OpenCL error -9999");
}

}  // namespace
}  // namespace defray::test
