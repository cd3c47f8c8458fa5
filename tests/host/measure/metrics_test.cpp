// Metrics and the edge band against closed forms and a brute-force twin.
#include "measure/metrics.h"

#include <cmath>
#include <limits>

#include "image/ldr.h"
#include "measure/edge_band.h"
#include "numbers.h"
#include "support.h"

namespace defray::test::metrics_test {
namespace {

std::vector<Plane> grey(std::size_t pixels, float value) {
  return {Plane(pixels, value), Plane(pixels, value), Plane(pixels, value)};
}

TEST(Metrics, SsimOfEqualPicturesIsOne) {
  for (const Size size : {Size{1, 1}, Size{1, 17}, Size{17, 1}, Size{13, 7}, Size{257, 89}}) {
    const Plane noise = random_plane(size, 3);
    const std::vector<Plane> picture{noise, noise, noise};
    EXPECT_NEAR(compare(picture, picture, size.width).ssim, 1, 1e-6) << size.width;
  }
}

TEST(Metrics, SsimOfFlatPicturesIsItsLuminanceTerm) {
  // No contrast: (2 m n + C1) / (m^2 + n^2 + C1), C1 = 0.01^2, of the encoded values m and n.
  const double m = srgb_encode(0.5), n = srgb_encode(0.1), c1 = 1e-4;
  const double expected = (2 * m * n + c1) / (m * m + n * n + c1);
  for (const int width : {1, 5, 35}) {
    EXPECT_NEAR(compare(grey(35, 0.5f), grey(35, 0.1f), width).ssim, expected, 1e-4) << width;
  }
  // Of three channels, one differs: the mean.
  std::vector<Plane> one = grey(35, 0.5f);
  one[1] = Plane(35, 0.1f);
  EXPECT_NEAR(compare(grey(35, 0.5f), one, 5).ssim, (2 + expected) / 3, 1e-4);
}

TEST(Metrics, SsimOfAnInvertedPatternIsNegative) {
  std::vector<Plane> a = grey(400, 0), b = grey(400, 0);
  for (std::size_t i = 0; i < 400; ++i) {
    for (std::size_t c = 0; c < 3; ++c) (((i + i / 20) % 2) ? a : b)[c][i] = 1;
  }
  // Equal means and variances v, covariance -v: (-2 v + C2) / (2 v + C2) with v = 1/4, C2 = 0.03^2.
  const double expected = (-0.5 + 9e-4) / (0.5 + 9e-4);
  EXPECT_NEAR(compare(a, b, 20).ssim, expected, 1e-2);
}

TEST(Metrics, EnergyRatioCountsEveryChannelUnclipped) {
  std::vector<Plane> a = grey(10, 2), b = grey(10, 2);
  a[2][3] = 62;  // + 60 on 60
  EXPECT_NEAR(compare(a, b, 5).energy_ratio, 2, 1e-9);
  EXPECT_FALSE(std::isfinite(compare(a, grey(10, 0), 5).energy_ratio));
  EXPECT_EQ(compare(grey(10, 0), grey(10, 0), 5).energy_ratio, 1) << "of black pictures";
}

TEST(Metrics, WorstPixelHasBothColours) {
  std::vector<Plane> a = grey(35, 0.5f), b = a;
  b[0][17] = 0.25f;
  a[2][17] = 7;
  const Comparison c = compare(a, b, 5);
  EXPECT_EQ(c.worst_x, 2);
  EXPECT_EQ(c.worst_y, 3);
  EXPECT_EQ(c.worst, 6.5);
  EXPECT_EQ(c.worst_a, (std::array<float, 3>{0.5f, 0.5f, 7}));
  EXPECT_EQ(c.worst_b, (std::array<float, 3>{0.25f, 0.5f, 0.5f}));
}

TEST(Metrics, NanIsWorstAndEqualInfinitiesAreEqual) {
  std::vector<Plane> a = grey(35, 0.5f), b = a;
  a[1][4] = b[1][4] = infinite;
  EXPECT_EQ(compare(a, b, 5).worst, 0);
  EXPECT_EQ(compare(a, b, 5).rms, 0);
  b[0][1] = 9;
  a[1][23] = b[1][23] = NAN;
  const Comparison c = compare(a, b, 5);
  EXPECT_TRUE(std::isnan(c.worst));
  EXPECT_EQ(c.worst_x, 3);
  EXPECT_EQ(c.worst_y, 4);
}

TEST(Metrics, ErrorsWhereCountsOnlyItsPixels) {
  std::vector<Plane> a = grey(10, 0.5f), b = a;
  std::vector<std::uint8_t> mask(10, 0);
  for (const std::size_t i : {2u, 5u}) {
    mask[i] = 1;
    for (Plane& plane : b) plane[i] = 0.6f;
  }
  const Errors inside = errors_where(a, b, mask, 1), outside = errors_where(a, b, mask, 0);
  EXPECT_EQ(inside.pixels, 2u);
  EXPECT_EQ(outside.pixels, 8u);
  EXPECT_NEAR(inside.rms, 0.1, 1e-6);
  EXPECT_NEAR(inside.psnr_linear_db, 20, 1e-4);
  EXPECT_TRUE(std::isinf(outside.psnr_srgb_db));
  EXPECT_TRUE(std::isnan(errors_where(a, b, std::vector<std::uint8_t>(10, 0), 1).rms));
  EXPECT_NEAR(compare(a, b, 5).rms, 0.1 * std::sqrt(0.2), 1e-6);
}

TEST(Metrics, RefusesOtherSizesAndPicturesWithoutColour) {
  expect_error(ErrorKind::usage, {"10 and 11 pixels"},
               [] { compare(grey(10, 0), grey(11, 0), 5); });
  expect_error(ErrorKind::usage, {"differ in size"}, [] { compare({}, grey(11, 0), 5); });
  expect_error(ErrorKind::usage, {"9 and 8"}, [] { errors_where(grey(9, 0), grey(8, 0), {}, 0); });
  expect_error(ErrorKind::usage, {"9 and 8"},
               [] { difference_picture(grey(9, 0), grey(8, 0), 4); });
}

TEST(DifferencePicture, IsWhiteWhereEqualAndDarkerBeyond) {
  std::vector<Plane> a = grey(4, 0.5f), b = a;
  b[0][1] = 0.6f;
  b[0][2] = 1;
  b[1][3] = NAN;
  const double step = srgb_encode(0.6) - srgb_encode(0.5);
  for (const double amplify : {1.0, 4.0}) {
    const auto shown = difference_picture(a, b, amplify);
    EXPECT_EQ(shown[0][0], 1);
    EXPECT_NEAR(srgb_encode(shown[0][1]), 1 - amplify * step, 1e-6);
    EXPECT_EQ(shown[2][1], 1);  // only red differs
    EXPECT_EQ(shown[1][3], 0);
  }
  EXPECT_EQ(difference_picture(a, b, 4)[0][2], 0);
  EXPECT_EQ(difference_picture(a, b, 4), difference_picture(b, a, 4));
}

/// The definition, pixel by pixel.
std::vector<std::uint8_t> edge_band_twin(const Plane& depth, int width,
                                         const std::vector<std::int32_t>& coc, double step) {
  const int height = static_cast<int>(depth.size()) / width;
  std::vector<std::uint8_t> band(depth.size(), 0);
  const auto stamp = [&](int px, int py, double reach) {
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const double distance2 = (x - px) * (x - px) + (y - py) * (y - py);
        if (distance2 <= reach * reach) band[std::size_t(y * width + x)] = 1;
      }
    }
  };
  const auto visit = [&](int px, int py, int qx, int qy) {
    if (qx >= width || qy >= height) return;
    const auto p = std::size_t(py * width + px), q = std::size_t(qy * width + qx);
    const double near = std::fmin(depth[p], depth[q]), far = std::fmax(depth[p], depth[q]);
    if (!(far > (1 + step) * near)) return;
    const double reach = std::fmax(std::abs(coc[p]), std::abs(coc[q])) / 256 + 1;
    stamp(px, py, reach);
    stamp(qx, qy, reach);
  };
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      visit(x, y, x + 1, y);
      visit(x, y, x, y + 1);
    }
  }
  return band;
}

TEST(EdgeBand, EqualsItsTwin) {
  for (const Size size :
       {Size{1, 1}, Size{1, 17}, Size{17, 1}, Size{13, 7}, Size{31, 29}, Size{97, 5}}) {
    for (const double step : {0.0, 0.1, 2.0}) {
      for (const double largest_px : {0.0, 2.0, 5.0, 1e6}) {
        // A few steps in an otherwise smooth depth: a band that is not everything.
        Plane depth = random_depth(size, 7);
        for (std::size_t i = 0; i < depth.size(); ++i) {
          if (i % 53 != 0) depth[i] = 4 + 0.001f * float(i % 3);
        }
        const auto coc = random_coc(size, largest_px, 11);
        EXPECT_EQ(edge_band(depth, size.width, coc, step),
                  edge_band_twin(depth, size.width, coc, step))
            << size.width << "x" << size.height << " " << step << " " << largest_px;
      }
    }
  }
}

TEST(EdgeBand, ReachesTheLargerRadiusOfAnEdgePlusOne) {
  // Depth 3 up to x = 9, then 6; radii 2.5 px and 0: the band is x = 9 and 10 and 3 px around.
  Plane depth(20, 3);
  std::vector<std::int32_t> coc(20, 640);
  for (std::size_t x = 10; x < 20; ++x) {
    depth[x] = 6;
    coc[x] = 0;
  }
  const auto band = edge_band(depth, 20, coc, 0.1);
  for (int x = 0; x < 20; ++x) EXPECT_EQ(band[std::size_t(x)], x >= 6 && x <= 13) << x;
}

TEST(EdgeBand, StepDecidesWhatIsAnEdge) {
  const std::vector<std::int32_t> sharp(2, 0);
  const auto is_edge = [&](float near, float far, double step) {
    return edge_band({near, far}, 2, sharp, step)[0] == 1;
  };
  EXPECT_TRUE(is_edge(1, 1.2f, 0.1));
  EXPECT_TRUE(is_edge(1.2f, 1, 0.1));
  EXPECT_FALSE(is_edge(1, 1.05f, 0.1));
  EXPECT_TRUE(is_edge(1, 1.05f, 0.01));
  EXPECT_TRUE(is_edge(1e9f, infinite, 100));
  EXPECT_FALSE(is_edge(infinite, infinite, 0));
  EXPECT_FALSE(is_edge(3, 3, 0));
  expect_error(ErrorKind::usage, {"edge_step is -1"}, [&] { is_edge(1, 2, -1); });
  expect_error(ErrorKind::usage, {"edge_step is nan"}, [&] { is_edge(1, 2, NAN); });
}

}  // namespace
}  // namespace defray::test::metrics_test
