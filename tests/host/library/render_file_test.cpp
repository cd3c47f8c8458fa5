// From file to file: what is refused comes before the work.
#include "defray/io.h"
#include "image/image_file.h"
#include "support.h"

namespace defray::test::render_file_test {
namespace {

TEST(RenderFile, LooksWhetherItCanWriteBeforeItReads) {
  const Folder folder;
  const std::string no_input = folder / "no.exr", out = folder / "out.exr";
  const std::string nowhere = folder / "no/such/place.exr";
  Device device = Device::open();
  const auto run = [&](const FramePaths& paths) { render_file(device, paths, {}); };
  expect_error(ErrorKind::output, {"place.exr"}, [&] { run({no_input, "", nowhere, ""}); });
  expect_error(ErrorKind::output, {"place.exr"}, [&] { run({no_input, "", out, nowhere}); });
  expect_error(ErrorKind::input, {"no.exr"}, [&] { run({no_input, "", out, ""}); });
}

/// As a caller from another language might give them.
TEST(RenderFile, RefusesNumbersThatNothingIsCalled) {
  const Folder folder;
  ImageFile::from_planes({"Y", "Z"}, {Plane(48, 0.5f), Plane(48, 3)}, 8, 6)
      .write(folder / "in.exr");
  Device device = Device::open();
  const auto refuses = [&](const std::vector<std::string>& words, const auto& change) {
    RenderSettings s;
    s.camera = {.focal_length_mm = 50, .fov_deg = 40, .fstop = 2, .focus_distance_units = 2};
    change(s);
    const FramePaths paths{folder / "in.exr", "", folder / "out.exr", ""};
    expect_error(ErrorKind::usage, words, [&] { render_file(device, paths, s); });
  };
  refuses({"bits", "is 5", "0 to 4"}, [](RenderSettings& s) { s.bits = Bits{5}; });
  refuses({"bits", "is -1"}, [](RenderSettings& s) { s.bits = Bits{-1}; });
  refuses({"grow", "is 3", "0 to 2"}, [](RenderSettings& s) { s.grow = Grow{3}; });
  refuses({"fit", "is 3", "0 to 2"}, [](RenderSettings& s) { s.camera.fit = SensorFit{3}; });
  EXPECT_FALSE(std::filesystem::exists(folder / "out.exr"));
}

}  // namespace
}  // namespace defray::test::render_file_test
