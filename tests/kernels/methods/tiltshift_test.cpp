// Kernel tiltshift and its twin: a gradient from a band to the frame's edges.
#include "methods/tiltshift.h"

#include <algorithm>

#include "faults/fault.h"
#include "reference/reference.h"
#include "support.h"

namespace defray::test::tiltshift_test {
namespace {

TEST(Tiltshift, KernelEqualsTwinBitForBit) {
  for (const Size size : awkward_sizes()) {
    for (const TiltshiftSettings& s : {TiltshiftSettings{0.5, 0.2, 9.2},
                                       {0, 0, 1024},
                                       {1, 1, 3},
                                       {0.3, 0.9, 0.01},
                                       {0.5, 1, 50}}) {
      const auto p = tiltshift_params(s, size.width, size.height, -3, size.height + 5);
      EXPECT_EQ(device().tiltshift(p), twins().tiltshift(p))
          << size.width << "x" << size.height << ", centre " << s.band_centre;
    }
  }
}

TEST(Tiltshift, SameBitsWhereNoBufferHoldsAPlane) {
  DeviceInfo info = device_under_test();
  for (const std::size_t rows : {1, 7, 96}) {
    info.max_buffer_bytes = (rows * 61 + 60) * sizeof(float);
    Session small(info);
    const auto p = tiltshift_params({0.3, 0.2, 12}, 61, 97, -3, 90);
    EXPECT_EQ(DeviceBackend(small).tiltshift(p), device().tiltshift(p)) << rows;
  }
}

TEST(Tiltshift, GrowsFromTheBandToTheFarthestEdge) {
  // 100 rows, the band from row 20 to row 40: the ramp of 60 rows ends at the bottom edge.
  const auto p = tiltshift_params({0.3, 0.2, 12}, 1, 100, 0, 100);
  const auto coc = twins().tiltshift(p);
  EXPECT_EQ(coc[25], 0);
  EXPECT_EQ(coc[20], 0);
  EXPECT_EQ(coc[39], 0);
  EXPECT_EQ(coc[99], std::lround(256 * 12 * 59.5 / 60));
  EXPECT_EQ(coc[69], std::lround(256 * 12 * 29.5 / 60));
  EXPECT_EQ(coc[0], std::lround(256 * 12 * 19.5 / 60));
}

TEST(Tiltshift, DataWindowsShareTheDisplayWindowsGradient) {
  const auto whole = twins().tiltshift(tiltshift_params({0.3, 0.2, 12}, 1, 100, 0, 100));
  const auto part = twins().tiltshift(tiltshift_params({0.3, 0.2, 12}, 1, 30, 55, 100));
  EXPECT_TRUE(std::equal(part.begin(), part.end(), whole.begin() + 55));
}

TEST(Tiltshift, DataBeyondTheFrameIsBlurredNoMoreThanItsEdge) {
  // Rows from 1000 above to 2000 below a frame of 10, and next to no ramp.
  for (const auto& s : {TiltshiftSettings{0.5, 0.99999999, 9}, {0.5, 0.2, 9}, {0, 0, 1024}}) {
    const auto p = tiltshift_params(s, 1, 3000, -1000, 10);
    const auto coc = device().tiltshift(p);
    EXPECT_EQ(coc, twins().tiltshift(p));
    EXPECT_EQ(*std::max_element(coc.begin(), coc.end()), std::lround(256 * s.max_blur_px));
  }
}

TEST(Tiltshift, BandAsHighAsTheFrameBlursNothing) {
  for (const auto q : twins().tiltshift(tiltshift_params({0.5, 1, 50}, 3, 40, 0, 40))) {
    EXPECT_EQ(q, 0);
  }
}

TEST(Tiltshift, RefusesBandsOutsideTheFrame) {
  expect_error(ErrorKind::usage, {"band_centre", "1.5"}, [] {
    validate(TiltshiftSettings{1.5, 0.1, 5});
  });
  expect_error(ErrorKind::usage, {"band_width", "-0.1"}, [] {
    validate(TiltshiftSettings{0.5, -0.1, 5});
  });
  expect_error(ErrorKind::usage, {"max_blur_px", "-1"}, [] {
    validate(TiltshiftSettings{0.5, 0.1, -1});
  });
  expect_error(ErrorKind::usage, {"max_blur_px", "1024"}, [] {
    validate(TiltshiftSettings{0.5, 0.1, 1e6});
  });
}

const FaultRows faults{
    {"tiltshift", "off by half a pixel", {"(float)row + 0.5f", "(float)row"}},
    {"tiltshift",
     "limit forgotten",
     {"fmin(p.slope_quanta_per_px * beyond, p.limit_quanta)", "p.slope_quanta_per_px * beyond"}},
};

}  // namespace
}  // namespace defray::test::tiltshift_test
