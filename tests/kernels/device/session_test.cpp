// OpenCL errors say what failed, where and why.
#include "opencl/session.h"

#include <fstream>
#include <set>

#include "chain/chain.h"
#include "kernels/kernel_files.h"
#include "lens/coc.h"
#include "lens/lens.h"
#include "opencl/launch_table.h"
#include "opencl/opencl_error.h"
#include "support.h"

namespace defray::test::session_test {
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
  constexpr std::size_t half = std::size_t{1} << 32;  // times itself it is 0
  expect_error(ErrorKind::usage, {"too many work-items"}, [&] { own.set_work_group(half, half); });
  for (const std::size_t x : {0, 5}) {
    expect_error(ErrorKind::usage, {"either both are 0"},
                 [&] { own.set_work_group("fill", x, 5 - x); });
  }
}

TEST(Session, WorkGroupsThatNoOneAskedForFitTheDevice) {
  DeviceInfo info = device_under_test();
  using Group = std::array<std::size_t, 2>;
  for (const auto& [most, group] : {std::pair{1, Group{1, 0}}, {48, {32, 0}}, {64, {64, 0}}}) {
    info.max_work_group = static_cast<std::size_t>(most);
    EXPECT_EQ(Session(info).group_of("coc"), group) << most;
  }
  info.max_work_group = 24;
  Session small(info);
  small.set_tuned({{"fill", {8, 8}}, {"split", {1, 64}}});
  EXPECT_EQ(small.group_of("fill"), (Group{4, 4}));
  EXPECT_EQ(small.group_of("split"), (Group{1, 16}));
  small.set_work_group("fill", 2, 3);
  EXPECT_EQ(small.group_of("fill"), (Group{2, 3}));
}

Session with_substitution(const Substitution& substitution) {
  SessionOptions options;
  options.substitutions = {substitution};
  return Session(device_under_test(), options);
}

TEST(Session, NamesTheArgumentThatIsNoneOfTheKernels) {
  const std::string said =
      "clSetKernelArg(coc, 3) failed on " + device_under_test().name + ": CL_INVALID_ARG";
  expect_error(ErrorKind::device, {said}, [] {
    const cl::Buffer buffer = session().buffer(4);
    session().launch("coc", {1}, DefrayCocParams{}, buffer, buffer, cl_uint{1});
  });
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
  own.set_work_group("mixed", 2, 1);
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

TEST(Session, BuffersBeyondTheDevicesLargestAreRefused) {
  DeviceInfo small = device_under_test();
  small.max_buffer_bytes = 8 << 20;
  Session own(small);
  expect_error(ErrorKind::device, {"a buffer of 16 MiB is needed", "at most 8 MiB", "memory"},
               [&] { own.buffer(16 << 20); });
  const std::vector<char> plane(16 << 20);
  expect_error(ErrorKind::device, {"16 MiB of one image plane", "at most 8 MiB", "max_coc_px"},
               [&] { own.view(plane); });
}

TEST(Session, GoesWithoutWhatItIsToldToGoWithout) {
  EXPECT_FALSE(session_without_int64().has_int64_atomics());
  SessionOptions scalars;
  scalars.use_vectors = false;
  EXPECT_FALSE(Session(device_under_test(), scalars).uses_vectors());
}

TEST(Session, OnlyCpusWorkInHostMemory) {
  EXPECT_EQ(device_under_test().shares_host_memory, device_under_test().type == "CPU");
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
               {"clBuildProgram", "defray_nonsense", place_of("chain/fill.cl", "__kernel void")},
               [] {
                 with_substitution({"__kernel void fill(", "defray_nonsense __kernel void fill("});
               });
  expect_error(ErrorKind::device, {place_of("rdb/rim.clh", "bool passes_rim(")}, [] {
    with_substitution({"bool passes_rim(", "defray_nonsense passes_rim("});
  });
}

TEST(Session, LogsThatCountTheProgramsLinesNameFileAndLineToo) {
  const std::string program = kernel_source({"chain/fill.cl"}, {});
  const std::string before = program.substr(0, program.find("__kernel void fill("));
  const auto line = std::count(before.begin(), before.end(), '\n') + 1;
  const std::string place = place_of("chain/fill.cl", "__kernel void");
  const auto log = [&](const std::string& file) {
    return file + std::to_string(line) + ":7: error: x\n" + file + "1:7: note: y";
  };
  const std::string first = program.substr(program.find('"') + 1);
  const std::string expected =
      place + "7: error: x\n" + first.substr(0, first.find('"')) + ":0:7: note: y";
  EXPECT_EQ(with_places(log("<kernel>:"), program), expected);
  EXPECT_EQ(with_places(log("input.cl:"), program), expected);
  EXPECT_EQ(with_places(log("other.cl:"), program), log("other.cl:"));
}

TEST(Session, BuildsTheFilesAskedFor) {
  SessionOptions options;
  options.files = {"methods/tiltshift.cl", "chain/mixed.cl"};
  const std::vector<std::string> expected{"mixed", "tiltshift"};
  EXPECT_EQ(Session(device_under_test(), options).kernel_names(), expected);
  options.files = {"nonesuch.cl"};
  expect_error(ErrorKind::internal, {"no kernel file 'nonesuch.cl'"},
               [&] { Session(device_under_test(), options); });
}

TEST(Session, EveryFileBuildsAlone) {
  std::set<std::string> names;
  for (const KernelFile& file : kernel_files) {
    if (!std::string(file.name).ends_with(".cl")) continue;
    SessionOptions options;
    options.files = {file.name};
    options.build_options = "-cl-opt-disable";
    for (const std::string& name : Session(device_under_test(), options).kernel_names()) {
      EXPECT_TRUE(names.insert(name).second) << name;
    }
  }
  EXPECT_EQ(std::vector<std::string>(names.begin(), names.end()), session().kernel_names());
}

/// A default render of a frame with everything in it.
void render_default(Session& session) {
  const Size size{64, 48};
  Plane depth(size.width * size.height, 4.0f);
  std::vector<std::int32_t> coc(depth.size(), 5 * 256);
  for (std::size_t i = 0; i < depth.size(); ++i) {
    if (i % 64 > 20 && i % 64 < 30) depth[i] = 1, coc[i] = -3 * 256;
  }
  DeviceBackend backend(session);
  run_chain({size.width, size.height, coc, depth, {{random_plane(size, 1)}}}, {}, backend);
}

TEST(Session, PlanesStayWhereTheyAre) {
  Session own(device_under_test());
  if (!own.works_in_host_memory()) GTEST_SKIP() << "the device has memory of its own";
  render_default(own);
  EXPECT_EQ(own.traffic().uploads + own.traffic().downloads, 0u);
  own.set_copies(true);
  render_default(own);
  EXPECT_GT(own.traffic().uploads, 0u);
  EXPECT_GT(own.traffic().downloads, 0u);
}

TEST(Session, CountsItsCopies) {
  Session own(device_under_test());
  const std::vector<float> there{1, 2, 3};
  std::vector<float> back(3);
  const cl::Buffer buffer = own.buffer(12);
  own.write(buffer, there.data(), 12);
  EXPECT_EQ(own.traffic().uploads, 1u);
  EXPECT_EQ(own.traffic().downloads, 0u);
  EXPECT_EQ(own.traffic().bytes, 12u);
  own.read(buffer, back.data(), 8, 4);
  EXPECT_EQ(back, (std::vector<float>{2, 3, 0}));
  EXPECT_EQ(own.traffic().uploads, 1u);
  EXPECT_EQ(own.traffic().downloads, 1u);
  EXPECT_EQ(own.traffic().bytes, 20u);
}

TEST(Session, WorkGroupsOfSingleKernels) {
  Session own(device_under_test());
  own.set_work_group("mixed", 7, 3);
  expect_error(ErrorKind::usage, {"work-items"},
               [&] { own.set_work_group("fill", own.info().max_work_group, 2); });
  DeviceBackend backend(own);
  const Frame frame{37, 23, random_coc({37, 23}, 9, 1)};
  EXPECT_EQ(backend.mixed(frame), twins().mixed(frame));
}

TEST(LaunchTable, HasEveryKernelOnce) {
  std::vector<std::string> names;
  for (const Launch& launch : launch_table()) names.push_back(launch.kernel);
  EXPECT_EQ(names, session().kernel_names());
  expect_error(ErrorKind::internal, {"nonesuch"}, [] { launch_of("nonesuch"); });
}

TEST(Session, MeasuresTheTimeOfEachKernelWhereAsked) {
  SessionOptions options;
  options.measures = true;
  Session own(device_under_test(), options);
  EXPECT_TRUE(own.take_kernel_seconds().empty());
  const Plane depth(1000, 2);
  DeviceBackend(own).coc(Lens(), 100, depth);
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
  const auto fast_coc = DeviceBackend(fast).coc(lens, 64, depth);
  for (std::size_t i = 0; i < depth.size(); ++i) {
    if (std::isinf(depth[i])) continue;  // -cl-fast-relaxed-math leaves open what Inf gives
    EXPECT_NEAR(fast_coc[i], strict_coc[i], 1) << depth[i];
  }
}

TEST(Session, ErrorNames) {
  EXPECT_EQ(opencl_error_name(-1), "CL_DEVICE_NOT_FOUND");
  EXPECT_EQ(opencl_error_name(-5), "CL_OUT_OF_RESOURCES");
  EXPECT_EQ(opencl_error_name(-30), "CL_INVALID_VALUE");
  EXPECT_EQ(opencl_error_name(-37), "CL_INVALID_HOST_PTR");
  EXPECT_EQ(opencl_error_name(-9999), "OpenCL error -9999");
}

}  // namespace
}  // namespace defray::test::session_test
