// OpenCL errors say what failed, where and why.
#include "opencl/session.h"

#include <filesystem>
#include <fstream>
#include <set>

#include "lens/coc.h"
#include "lens/lens.h"
#include "support.h"

namespace defray::test {
namespace {

TEST(Session, AnUnknownKernelIsNamed) {
  expect_error(ErrorKind::device,
               {"clCreateKernel nonesuch", "CL_INVALID_KERNEL_NAME", session().info().name},
               [] { session().launch("nonesuch", {1}); });
}

TEST(Session, BuffersBeyondTheDevicesLimitAreRefused) {
  const std::size_t too_much = session().info().max_buffer_bytes + 1;
  expect_error(ErrorKind::device, {"allows at most", "memory"},
               [&] { session().buffer(too_much); });
  const char byte = 0;
  expect_error(ErrorKind::device, {"allows at most", "max_coc_px"},
               [&] { session().view(&byte, too_much); });
}

TEST(Session, WorkGroupsBeyondTheDevicesLimitAreRefused) {
  Session own(device_under_test());
  expect_error(ErrorKind::usage, {"work-items", "allows at most"},
               [&] { own.set_work_group(own.info().max_work_group, 2); });
}

Session with_substitution(const Substitution& substitution) {
  SessionOptions options;
  options.substitutions = {substitution};
  return Session(device_under_test(), options);
}

TEST(Session, WorkGroupsAreOfOneKernelOrOfAll) {
  Session own = with_substitution({"__kernel void coc(",
                                   "__kernel void coc(__global uint* size) {\n"
                                   "  size[0] = get_local_size(0);\n"
                                   "  size[1] = get_local_size(1);\n"
                                   "}\n"
                                   "__kernel void former_coc("});
  const auto size_of_group = [&] {
    std::array<std::uint32_t, 2> size{};
    const cl::Buffer buffer = own.buffer(sizeof size);
    own.launch("coc", {64, 4}, buffer);
    own.read(buffer, size.data(), sizeof size);
    return size;
  };
  using Size = std::array<std::uint32_t, 2>;
  own.set_work_group(8, 2);
  EXPECT_EQ(size_of_group(), (Size{8, 2}));
  own.set_work_group("coc", 4, 4);
  own.set_work_group("edges", 2, 1);
  EXPECT_EQ(size_of_group(), (Size{4, 4}));
  own.set_work_group(8, 1);
  EXPECT_EQ(size_of_group(), (Size{8, 1}));
  expect_error(ErrorKind::usage, {"work-items", "allows at most"},
               [&] { own.set_work_group("coc", own.info().max_work_group, 2); });
}

TEST(Session, SubstitutionsMustHitOnceUnlessTheyAreForEverywhere) {
  expect_error(ErrorKind::internal, {"'no such text'", "0 times"}, [] {
    with_substitution({"no such text", ""});
  });
  expect_error(ErrorKind::internal, {"'__kernel void'", "times in the kernels"}, [] {
    with_substitution({"__kernel void", "kernel void"});
  });
  EXPECT_EQ(with_substitution({"__kernel void", "kernel void", true}).kernel_names(),
            session().kernel_names());
}

/// "kernels/NAME:LINE:" of the first line that holds this text.
std::string place_of(const std::string& name, const std::string& text) {
  std::ifstream file(DEFRAY_SOURCE_DIR "/kernels/" + name);
  std::string line;
  for (int number = 1; std::getline(file, line); ++number) {
    if (line.find(text) != std::string::npos) return fmt::format("kernels/{}:{}:", name, number);
  }
  return "nowhere";
}

TEST(Session, BuildErrorsNameFileAndLine) {
  expect_error(ErrorKind::device,
               {"clBuildProgram", "defray_nonsense", place_of("fill.cl", "__kernel void")}, [] {
                 with_substitution({"__kernel void fill(", "defray_nonsense __kernel void fill("});
               });
  expect_error(ErrorKind::device, {place_of("rim.clh", "bool passes_rim(")}, [] {
    with_substitution({"bool passes_rim(", "defray_nonsense passes_rim("});
  });
}

TEST(Session, BuildsTheFilesAskedFor) {
  SessionOptions options;
  options.files = {"tiltshift.cl", "edges.cl"};
  const std::vector<std::string> expected{"edges", "repair", "tiltshift"};
  EXPECT_EQ(Session(device_under_test(), options).kernel_names(), expected);
  options.files = {"nonesuch.cl"};
  expect_error(ErrorKind::internal, {"no kernel file 'nonesuch.cl'"},
               [&] { Session(device_under_test(), options); });
}

TEST(Session, EveryFileBuildsAlone) {
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(DEFRAY_SOURCE_DIR "/kernels")) {
    if (entry.path().extension() != ".cl") continue;
    SessionOptions options;
    options.files = {entry.path().filename()};
    options.build_options = "-cl-opt-disable";
    for (const std::string& name : Session(device_under_test(), options).kernel_names()) {
      EXPECT_TRUE(names.insert(name).second) << name;
    }
  }
  EXPECT_EQ(std::vector<std::string>(names.begin(), names.end()), session().kernel_names());
}

TEST(Session, MeasuresTheTimeOfEachKernelWhereAsked) {
  SessionOptions options;
  options.measures = true;
  Session own(device_under_test(), options);
  EXPECT_TRUE(own.take_kernel_seconds().empty());
  const Plane depth(1000, 2);
  DeviceStages(own).coc(Lens(), 100, depth);
  const auto seconds = own.take_kernel_seconds();
  ASSERT_EQ(seconds.size(), 1u);
  EXPECT_EQ(seconds.begin()->first, "coc");
  EXPECT_GE(seconds.begin()->second, 0);
  EXPECT_TRUE(own.take_kernel_seconds().empty());
  device().coc(Lens(), 100, depth);
  EXPECT_TRUE(session().take_kernel_seconds().empty());
}

TEST(Session, FastArithmeticBuildsAndStaysNear) {
  SessionOptions options;
  options.math = Math::fast;
  Session fast(device_under_test(), options);
  EXPECT_EQ(fast.kernel_names(), session().kernel_names());
  Lens lens;
  lens.focus_distance_units = 3;
  lens.aperture_diameter_mm = 100;
  const Plane depth = random_depth({64, 16}, 1);
  const auto strict_coc = device().coc(lens, 64, depth);
  const auto fast_coc = DeviceStages(fast).coc(lens, 64, depth);
  for (std::size_t i = 0; i < depth.size(); ++i) {
    if (std::isinf(depth[i])) continue;  // -cl-fast-relaxed-math leaves open what Inf gives
    EXPECT_NEAR(fast_coc[i], strict_coc[i], 1) << depth[i];
  }
}

TEST(Session, ErrorNames) {
  EXPECT_EQ(opencl_error_name(-30), "CL_INVALID_VALUE");
  EXPECT_EQ(opencl_error_name(-9999), "OpenCL error -9999");
}

}  // namespace
}  // namespace defray::test
