// Pictures as apertures: which way up, how large, in which light; and the table of boxes.
#include <OpenImageIO/imageio.h>

#include <cmath>

#include "image/image_file.h"
#include "image/ldr.h"
#include "lens/aperture_mask.h"
#include "lens/aperture_table.h"
#include "lens/lens_points.h"
#include "support.h"

namespace defray::test::aperture_picture_test {
namespace {

constexpr int side = ApertureMask::side;

std::string write_grey(const Folder& folder, int width, int height, const Plane& light) {
  const std::string path = folder / "bokeh.exr";
  ImageFile::from_planes({"R", "G", "B"}, {light, light, light}, width, height,
                         Sample::single_float)
      .write(path);
  return path;
}

Aperture picture(const std::string& path, double squeeze = 1) {
  return {0, 0, 0, squeeze, path, 0};
}

// x = p + r (u, v): upright behind the focus, upside down and back to front before it.
TEST(AperturePicture, IsUprightBehindTheFocusAndTurnedInFront) {
  const Folder folder;
  const Aperture top_left = picture(write_grey(folder, 2, 2, {1, 0, 0, 0}));
  const ApertureMask mask = rasterise(top_left);
  EXPECT_EQ(mask.at(0, 0), 255);
  EXPECT_EQ(mask.at(side / 2, 0), 0);
  EXPECT_EQ(mask.at(0, side / 2), 0);
  const ApertureTable table = make_aperture_table(mask);
  EXPECT_EQ(light_in_box(table, -65536, -65536, 0, 0), table.total());
  for (const double r : {20.0, -20.0}) {
    for (const auto& [u, v] : make_lens_points(top_left, 200).points) {
      const double right = r * u, down = r * v;
      EXPECT_LE(r > 0 ? right : -right, 0) << r;
      EXPECT_LE(r > 0 ? down : -down, 0) << r;
    }
  }
}

TEST(AperturePicture, KeepsProportionsOfItsLight) {
  const Folder folder;
  const ApertureMask mask = rasterise(picture(write_grey(folder, 2, 2, {0.5f, 0.3f, 0.1f, 0})));
  EXPECT_EQ(mask.at(10, 10), 255);
  EXPECT_EQ(mask.at(500, 10), 153);
  EXPECT_EQ(mask.at(10, 500), 51);
  EXPECT_EQ(mask.at(500, 500), 0);
}

TEST(AperturePicture, LongerSideSpansTheSquare) {
  const Folder folder;
  const std::string wide = write_grey(folder, 4, 1, Plane(4, 7.0f));
  const ApertureMask band = rasterise(picture(wide)), square = rasterise(picture(wide, 4)),
                     tall = rasterise(picture(wide, 8));
  for (int row = 0; row < side; ++row) {
    for (int column = 0; column < side; ++column) {
      const bool in_rows = row >= 192 && row < 320, in_columns = column >= 128 && column < 384;
      ASSERT_EQ(band.at(column, row), in_rows ? 255 : 0) << column << "," << row;
      ASSERT_EQ(square.at(column, row), 255) << column << "," << row;
      ASSERT_EQ(tall.at(column, row), in_columns ? 255 : 0) << column << "," << row;
    }
  }
}

TEST(AperturePicture, TexelsAreMeansOfThePixelsUnderThem) {
  const Folder folder;
  constexpr int pixels = 3 * side;  // 3 x 3 a texel
  Plane light(static_cast<std::size_t>(pixels) * pixels);
  for (std::size_t i = 0; i < light.size(); ++i) light[i] = static_cast<float>(i * 7919 % 101);
  for (int j = 0; j < 9; ++j) light[(j / 3) * pixels + j % 3] = 100;
  const ApertureMask mask = rasterise(picture(write_grey(folder, pixels, pixels, light)));
  EXPECT_EQ(mask.at(0, 0), 255);
  for (const int at : {1, 77, 300, 511}) {
    double sum = 0;
    for (int j = 0; j < 3; ++j) {
      for (int i = 0; i < 3; ++i) sum += light[(3 * at + j) * pixels + 3 * (at / 2) + i];
    }
    EXPECT_NEAR(mask.at(at / 2, at), sum / 9 / 100 * 255, 0.51);
  }
}

TEST(AperturePicture, IsReadAsLinearLuminance) {
  const Folder folder;
  const std::string path = folder / "green.exr";
  ImageFile::from_planes({"R", "G", "B"}, {{1, 0}, {1, 1}, {1, 0}}, 2, 1).write(path);
  EXPECT_EQ(rasterise(picture(path)).at(500, side / 2), std::lround(0.7152 * 255));
  ImageFile::from_planes({"Y"}, {{1, 0.25f}}, 2, 1).write(path);
  EXPECT_EQ(rasterise(picture(path)).at(500, side / 2), 64);
  const std::string png = folder / "half.png";
  write_ldr(png, {2, 1, {"R", "G", "B"}, {{1, 0.5f}, {1, 0.5f}, {1, 0.5f}}});
  // A step of the PNG near 0.5 is 0.9 % of the light there: 1.2 of 255 steps, half of it each way.
  EXPECT_NEAR(rasterise(picture(png)).at(500, side / 2), 127.5, 1.2);
}

/// Whose data window lies 2 px right of and 1 px below its display window, which begins at `at`.
void expect_display_window(int at_x, int at_y) {
  const Folder folder;
  const std::string path = folder / "cropped.exr";
  OIIO::ImageSpec spec(2, 4, 1, OIIO::TypeDesc::FLOAT);
  spec.channelnames = {"Y"};
  spec.x = at_x + 2, spec.y = at_y + 1;
  spec.full_width = spec.full_height = 4;
  spec.full_x = at_x, spec.full_y = at_y;
  const auto out = OIIO::ImageOutput::create(path);
  ASSERT_TRUE(out && out->open(path, spec));
  const float pixels[8] = {0, 1, 0, 0, 0, 0, 1, 1};  // the last row is below the window
  ASSERT_TRUE(out->write_image(OIIO::TypeDesc::FLOAT, pixels) && out->close());
  const ApertureMask mask = rasterise(picture(path));
  for (int row = 0; row < side; ++row) {
    for (int column = 0; column < side; ++column) {
      const bool is_lit = column / 128 == 3 && row / 128 == 1;
      ASSERT_EQ(mask.at(column, row), is_lit ? 255 : 0) << column << "," << row;
    }
  }
}

TEST(AperturePicture, ShowsItsDisplayWindow) {
  expect_display_window(0, 0);
  expect_display_window(7, -5);
}

TEST(AperturePicture, SamplesFollowItsLight) {
  const Folder folder;
  Plane ramp;
  for (int i = 0; i < 64 * 64; ++i) ramp.push_back(static_cast<float>(i % 64 + i / 64));
  const Aperture a = picture(write_grey(folder, 64, 64, ramp));
  const ApertureTable table = make_aperture_table(rasterise(a));
  const LensPoints lens = make_lens_points(a, 1024);
  for (const std::int32_t u : {-30000, 0, 20000, 65536}) {
    for (const std::int32_t v : {-20000, 0, 40000, 65536}) {
      const double light = static_cast<double>(light_in_box(table, -65536, -65536, u, v)) /
                           static_cast<double>(table.total());
      double inside = 0;
      for (const auto& [cu, cv] : lens.points) inside += cu < u && cv < v ? 1.0 / 1024 : 0;
      // Half a standard deviation of random points: 32 of those would not stay within it.
      EXPECT_NEAR(inside, light, 8.0 / 1024) << u << "," << v;
    }
  }
}

TEST(AperturePicture, AllLightOfALoneTexelIsThere) {
  const Folder folder;
  for (const auto& [x, y] : {std::pair{0, 0},
                             {side - 1, 0},
                             {0, side - 1},
                             {side - 1, side - 1},
                             {side / 2, side / 2},
                             {17, 300}}) {
    Plane light(static_cast<std::size_t>(side * side));
    light[static_cast<std::size_t>(y * side + x)] = 3;
    const Aperture lone = picture(write_grey(folder, side, side, light));
    constexpr int texel = 2 * 65536 / side;
    const int left = x * texel - 65536, top = y * texel - 65536;
    const ApertureTable table = make_aperture_table(rasterise(lone));
    EXPECT_EQ(light_in_box(table, left, top, left + texel, top + texel), table.total());
    for (const auto& [u, v] : make_lens_points(lone, 5).points) {
      EXPECT_TRUE(u >= left && u <= left + texel && v >= top && v <= top + texel)
          << x << " " << y << ": " << u << " " << v;
    }
  }
}

TEST(AperturePicture, SamplesOfASymmetricPictureMoveNothing) {
  const Folder folder;
  const Size size{9, 6};
  Plane light = random_plane(size, 5);
  for (std::size_t i = 0; i < light.size(); ++i) {
    light[i] = std::fabs(light[i]);
    light[light.size() - 1 - i] = light[i];
  }
  const Aperture a = picture(write_grey(folder, size.width, size.height, light));
  for (const int count : {1, 16, 69, 1025}) {
    std::int64_t u = 0, v = 0;
    for (const auto& [cu, cv] : make_lens_points(a, count).points) u += cu, v += cv;
    EXPECT_LE(std::abs(u), count) << count;
    EXPECT_LE(std::abs(v), count) << count;
  }
}

// The promise of lens_points.h. Over 150 seeds the root mean square is 0.8 / count, the largest
// 3.1 / count; random points' is 0.8 / sqrt(count).
TEST(AperturePicture, SamplesKeepItsCentroid) {
  const Folder folder;
  for (const std::uint32_t seed : {1u, 2u, 3u}) {
    Plane light = random_plane({7, 9}, seed);
    for (float& value : light) value = std::fabs(value);
    const Aperture a = picture(write_grey(folder, 7, 9, light));
    const ApertureMask mask = rasterise(a);
    double u = 0, v = 0, total = 0;
    for (int i = 0; i < side * side; ++i) {
      const double value = mask.coverage[i];
      u += value * (2 * (i % side) + 1 - side) / side;
      v += value * (2 * (i / side) + 1 - side) / side;
      total += value;
    }
    for (const int count : {16, 69, 144, 400, 1025}) {
      double su = 0, sv = 0;
      for (const auto& [cu, cv] : make_lens_points(a, count).points) su += cu, sv += cv;
      const double off = std::hypot(su / 65536 / count - u / total, sv / 65536 / count - v / total);
      EXPECT_LE(off, 4.0 / count) << seed << " " << count;
    }
  }
}

TEST(AperturePicture, RefusesPicturesWithoutLight) {
  const Folder folder;
  const auto refused = [](const std::string& path, const std::string& why) {
    expect_error(ErrorKind::input, {path, why}, [&] { rasterise(picture(path)); });
  };
  refused(write_grey(folder, 3, 3, Plane(9, 0.0f)), "black");
  refused(write_grey(folder, 2, 1, {1, -1.0f}), "-1 at pixel 1,0: an aperture lets 0 or more");
  refused(write_grey(folder, 2, 1, {1, NAN}), "NaN or Inf at pixel 1,0");
  refused(folder / "missing.png", "no such file");
}

}  // namespace
}  // namespace defray::test::aperture_picture_test
