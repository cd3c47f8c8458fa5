// From file to file: what is refused comes before the work.
#include "defray/io.h"
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

}  // namespace
}  // namespace defray::test::render_file_test
