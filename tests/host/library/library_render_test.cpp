// What of a picture in memory, a lens and options reaches the picture that the library gives: each
// setting changes what it should, and nothing else.
#include <cmath>

#include "defray/defray.h"
#include "support.h"

namespace defray::test::library_render_test {
namespace {

const Size size{40, 30};

struct Memory {
  std::vector<Plane> colour = {random_plane(size, 1), random_plane(size, 2), random_plane(size, 3)};
  Plane depth = random_depth(size, 4);
  Window data{0, 0, size.width, size.height};
  Window display{};

  Picture picture() const {
    Picture p{data, display, {}, depth};
    for (const Plane& plane : colour) p.colour.push_back(plane);
    return p;
  }
};

Lens lens() {
  Lens l;
  l.focus_distance_units = 2;
  l.aperture_diameter_mm = 60;
  return l;
}

RenderResult rendered(const Memory& memory, const Options& options = {}) {
  static Device device = Device::open();
  return render(device, memory.picture(), lens(), options);
}

Options literal() {
  Options options;
  options.chain.reset();
  return options;
}

TEST(LibraryRender, TiltshiftsBandStaysSharpAndTheRestFollowsItsBlur) {
  const Memory memory;
  Options options;
  options.method = Method::tiltshift;
  options.tiltshift = {.band_centre = 0.5, .band_width = 0.4, .max_blur_px = 3};
  const RenderResult some = rendered(memory, options);
  const std::size_t middle = size.width * (size.height / 2) + 5, top = 5;
  EXPECT_EQ(some.colour[0][middle], memory.colour[0][middle]);
  EXPECT_NE(some.colour[0][top], memory.colour[0][top]);
  // At the first row's middle, half a pixel from the edge.
  const double share = (0.5 - 0.2 - 0.5 / size.height) / (0.5 - 0.2);
  EXPECT_NEAR(some.report.farthest_coc_px, 3 * share, 1.0 / 256);
  options.tiltshift.max_blur_px = 0;
  EXPECT_EQ(rendered(memory, options).colour, memory.colour);
}

TEST(LibraryRender, TheSecondOfTwoPlanesIsAlphaAndStaysOpaqueWhereLampsAre) {
  Memory grey;
  Plane light = grey.colour[0];
  for (std::size_t i = 5; i < light.size(); i += 97) light[i] = 100;
  grey.colour = {light, Plane(light.size(), 1.0f)};
  const RenderResult some = rendered(grey);
  for (const float alpha : some.colour[1]) EXPECT_NEAR(alpha, 1, 1e-5f);
}

TEST(LibraryRender, TheLensKnowsWhereInTheFrameThePictureLies) {
  Options options;
  options.chain->aperture.cats_eye = 1;
  Memory memory;
  const auto at = [&](int x, int y) {
    memory.data = {x, y, size.width, size.height};
    memory.display = {0, 0, 3 * size.width, 3 * size.height};
    return rendered(memory, options).colour;
  };
  const auto middle = at(size.width, size.height);
  EXPECT_NE(at(0, size.height), middle);
  EXPECT_NE(at(size.width, 0), middle);
  memory.display = {7, -3, 3 * size.width, 3 * size.height};
  memory.data = {size.width + 7, size.height - 3, size.width, size.height};
  EXPECT_EQ(rendered(memory, options).colour, middle);
}

TEST(LibraryRender, DepthIsWhatTheOptionsSay) {
  Memory memory;
  const std::vector<float> as_z = rendered(memory, literal()).coc_px;
  for (float& z : memory.depth) z = 1 / z;
  Options inverse = literal();
  inverse.depth.kind = DepthKind::inverse;
  const std::vector<float> as_inverse = rendered(memory, inverse).coc_px;
  EXPECT_NE(rendered(memory, literal()).coc_px, as_z);
  for (std::size_t i = 0; i < as_z.size(); ++i) ASSERT_NEAR(as_inverse[i], as_z[i], 0.02) << i;
}

TEST(LibraryRender, BackgroundIsCountedAndAtInfinity) {
  Memory memory;
  const RenderResult without = rendered(memory, literal());
  memory.depth[7] = 123;
  Options options = literal();
  options.depth.background = 123;
  const RenderResult with = rendered(memory, options);
  EXPECT_EQ(with.report.depth.background, without.report.depth.background + 1);
  EXPECT_GT(with.coc_px[7], rendered(memory, literal()).coc_px[7]);
}

TEST(LibraryRender, TheDisplayWindowSaysHowLargeThePixelsAre) {
  Memory memory;
  const RenderResult whole = rendered(memory, literal());
  memory.display = memory.data;
  EXPECT_EQ(rendered(memory, literal()).coc_px, whole.coc_px);
  // The same data as the overscan of a frame of half its width: pixels are twice as large.
  memory.display = {10, 7, size.width / 2, size.height / 2};
  const RenderResult overscan = rendered(memory, literal());
  for (std::size_t i = 0; i < whole.coc_px.size(); ++i) {
    ASSERT_NEAR(overscan.coc_px[i], whole.coc_px[i] / 2, 0.01) << i;
  }
}

TEST(LibraryRender, NumbersThatAreNoneAreCountedOrRefused) {
  Memory memory;
  memory.colour[1][3] = NAN;
  memory.colour[2][9] = HUGE_VALF;
  Options options = literal();
  options.nonfinite = Nonfinite::error;
  expect_error(ErrorKind::input, {"the picture"}, [&] { rendered(memory, options); });
  options.nonfinite = Nonfinite::zero;
  const RenderResult zeroed = rendered(memory, options);
  EXPECT_EQ(zeroed.report.nonfinite, 2u);
  memory.colour[1][3] = memory.colour[2][9] = 0;
  EXPECT_EQ(rendered(memory, literal()).colour, zeroed.colour);
}

TEST(LibraryRender, GivesWhatIsAskedFor) {
  const Memory memory;
  Options options = literal();
  EXPECT_TRUE(rendered(memory, options).nearest.empty());
  EXPECT_TRUE(rendered(memory, options).confidence.empty());
  EXPECT_FALSE(rendered(memory, options).report.chain);
  options.wants_nearest = true;
  EXPECT_EQ(rendered(memory, options).nearest.size(), size.width * size.height);
  const RenderResult chain = rendered(memory);
  EXPECT_EQ(chain.confidence.size(), size.width * size.height);
  EXPECT_TRUE(chain.report.chain);
}

}  // namespace
}  // namespace defray::test::library_render_test
