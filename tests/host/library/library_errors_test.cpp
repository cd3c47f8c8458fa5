// What the library refuses of a picture in memory, and what a method does not need.
#include "defray/defray.h"
#include "support.h"

namespace defray::test::library_errors_test {
namespace {

struct Memory {
  Plane colour = Plane(48, 0.5f), depth = Plane(48, 3);
  Picture picture() const {
    Picture p;
    p.data = p.display = {0, 0, 8, 6};
    p.colour = {colour, colour, colour};
    p.depth = depth;
    return p;
  }
};

Lens lens() {
  Lens l;
  l.focus_distance_units = 2;
  return l;
}

TEST(Library, RefusesPlanesThatDoNotFit) {
  const Memory memory;
  Device device = Device::open();
  const auto refuses = [&](const std::vector<std::string>& words, const auto& change) {
    Picture p = memory.picture();
    change(p);
    expect_error(ErrorKind::usage, words, [&] { render(device, p, lens()); });
  };
  refuses({"depth plane", "0 values", "48 pixels"}, [](Picture& p) { p.depth = {}; });
  refuses({"plane of colour", "47 values"},
          [](Picture& p) { p.colour[1] = p.colour[1].subspan(1); });
  refuses({"1 to 4 planes", "0"}, [](Picture& p) { p.colour.clear(); });
  refuses({"1 to 4 planes", "5"}, [](Picture& p) { p.colour.resize(5, p.colour[0]); });
  refuses({"data window", "no pixels"}, [](Picture& p) { p.data.width = 0; });
  refuses({"data window", "no pixels"}, [](Picture& p) { p.data.height = -1; });
  refuses({"data window 65537x1", "65536 pixels a side"}, [](Picture& p) {
    p.data = {0, 0, 65537, 1};
  });
  refuses({"is too large", "268435456 in all"}, [](Picture& p) { p.data = {0, 0, 20000, 20000}; });
  refuses({"display window", "no pixels"}, [](Picture& p) { p.display.width = -1; });
}

/// As a caller from another language might give them.
TEST(Library, RefusesNumbersThatNothingIsCalled) {
  const Memory memory;
  Device device = Device::open();
  const auto refuses = [&](const std::vector<std::string>& words, const auto& change) {
    Options o;
    change(o);
    expect_error(ErrorKind::usage, words, [&] { render(device, memory.picture(), lens(), o); });
  };
  refuses({"method", "is 4", "0 to 3"}, [](Options& o) { o.method = Method{4}; });
  refuses({"border", "is -1", "0 to 2"}, [](Options& o) { o.chain->border = Border{-1}; });
  refuses({"pattern_shifts", "is -1", "1 to 64"}, [](Options& o) { o.chain->pattern_shifts = -1; });
  refuses({"depth.kind", "is 6", "0 to 5"}, [](Options& o) { o.depth.kind = DepthKind{6}; });
  refuses({"nonfinite", "is 3", "0 to 2"}, [](Options& o) { o.nonfinite = Nonfinite{3}; });
  for (const std::string name : {"", "reference"}) {
    expect_error(ErrorKind::usage, {"math", "is 2", "0 to 1"},
                 [&] { Device::open(name, {.math = Math{2}}); });
  }
}

TEST(Library, TiltshiftNeedsNoDepth) {
  const Memory memory;
  Device device = Device::open();
  Picture p = memory.picture();
  p.depth = {};
  Options options;
  options.method = Method::tiltshift;
  EXPECT_EQ(render(device, p, lens(), options).colour.size(), 3u);
}

}  // namespace
}  // namespace defray::test::library_errors_test
