// What words and numbers on the command line mean, and what `defray devices` says of a device.
#include "options/parse.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "command/program.h"
#include "defray/device.h"

namespace defray::test::parse_test {
namespace {

using nlohmann::json;

TEST(Parse, UnitsAreMetres) {
  for (const auto& [text, metres] : {std::pair{"m", 1.0},
                                     {"cm", 0.01},
                                     {"mm", 0.001},
                                     {"km", 1e3},
                                     {"ft", 0.3048},
                                     {"in", 0.0254},
                                     {"2.5", 2.5},
                                     {"1e-9", 1e-9}}) {
    EXPECT_EQ(cli::parse_unit(text), metres);
    EXPECT_EQ(cli::parse_unit(cli::unit_of(metres)), metres) << text;
  }
  for (const char* text : {"", "miles", "0", "-1", "inf", "nan", "1m", "1 "}) {
    expect_error(ErrorKind::usage, {"--unit"}, [&] { cli::parse_unit(text); });
  }
}

TEST(Parse, Backgrounds) {
  EXPECT_EQ(cli::parse_background("none"), INFINITY);
  EXPECT_EQ(cli::parse_background("1e10"), 1e10);
  EXPECT_EQ(cli::parse_background("+3"), 3);
  EXPECT_EQ(cli::parse_background("-1"), -1);
  for (const char* text : {"", "+", "+-3", "nan", "3x", "nothing"}) {
    expect_error(ErrorKind::usage, {"--background"}, [&] { cli::parse_background(text); });
  }
}

TEST(Parse, WorkGroupsOfAllKernelsComeFirst) {
  const auto groups = cli::parse_work_groups("fill=8x2,64,coc=16");
  ASSERT_EQ(groups.size(), 3u);
  const auto expect = [&](std::size_t i, const std::string& kernel, std::size_t x, std::size_t y) {
    EXPECT_EQ(groups[i].kernel, kernel);
    EXPECT_EQ(groups[i].x, x);
    EXPECT_EQ(groups[i].y, y);
  };
  expect(0, "", 64, 1);
  expect(1, "fill", 8, 2);
  expect(2, "coc", 16, 1);
  expect_error(ErrorKind::usage, {"all kernels", "second time"},
               [] { cli::parse_work_groups("64,8x8"); });
  for (const char* text : {"", "0", "8x0", "8x", "fill=", "1234567", "8,,8x1"}) {
    expect_error(ErrorKind::usage, {"--work-group"}, [&] { cli::parse_work_groups(text); });
  }
}

TEST(Devices, AreDescribedInWholeUnits) {
  const Folder folder;
  const auto devices = Device::list();
  const std::string text = defray(folder, "devices").out;
  const json list = json::parse(defray(folder, "devices --json").out);
  ASSERT_EQ(list.size(), devices.size());
  for (std::size_t i = 0; i < devices.size(); ++i) {
    const DeviceProperties& d = devices[i];
    const std::vector<std::string> lines = {
        fmt::format("{}: {}\n", i, d.name),
        fmt::format("memory      {} MiB, largest buffer {} MiB, local {} KiB\n",
                    d.global_memory_bytes / 1048576, d.max_buffer_bytes / 1048576,
                    d.local_memory_bytes / 1024),
        fmt::format("{} compute units, work-groups up to {}\n", d.compute_units, d.max_work_group),
        fmt::format("double {}\n", d.has_double ? "yes" : "no")};
    for (const std::string& line : lines) EXPECT_NE(text.find(line), std::string::npos) << line;
    EXPECT_EQ(list[i]["name"], d.name);
    EXPECT_EQ(list[i]["global_memory_bytes"], d.global_memory_bytes);
    EXPECT_EQ(list[i]["max_buffer_bytes"], d.max_buffer_bytes);
    EXPECT_EQ(list[i]["max_work_group"], d.max_work_group);
    EXPECT_EQ(list[i]["double"], d.has_double);
  }
}

}  // namespace
}  // namespace defray::test::parse_test
