// The built-in scenes, and what their renderers promise.
#include "scenes/scene.h"

#include <cmath>
#include <fstream>
#include <numbers>
#include <numeric>

#include "lens/camera.h"
#include "scenes/builtin/builtin.h"
#include "scenes/geometry/primitives.h"
#include "scenes/tracing/render.h"
#include "support.h"

namespace defray::test::scene_test {
namespace {

bool is_finite(const std::vector<Plane>& planes) {
  for (const Plane& plane : planes) {
    for (const float value : plane) {
      if (!std::isfinite(value) || value < 0) return false;
    }
  }
  return true;
}

Truth default_truth(const Scene& scene, int samples, std::uint32_t seed = 1) {
  return render_truth(scene, lens_of(scene, scene.settings[0]), samples, seed);
}

class EachScene : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Builtin, EachScene, testing::ValuesIn(scene_names()), [](const auto& p) {
  std::string name = p.param;
  std::erase(name, '-');
  return name;
});

TEST_P(EachScene, RendersAtAnySize) {
  for (const Size size : {Size{1, 1}, {17, 1}, {97, 53}}) {
    const Scene scene = make_scene(GetParam(), size.width, size.height);
    const ScenePicture pinhole = render_pinhole(scene), hidden = render_hidden(scene);
    EXPECT_TRUE(is_finite(pinhole.colour));
    EXPECT_TRUE(is_finite(hidden.colour));
    EXPECT_LT(*std::min_element(pinhole.depth.begin(), pinhole.depth.end()), 1e9);
    for (std::size_t i = 0; i < pinhole.depth.size(); ++i) {
      EXPECT_GT(pinhole.depth[i], 0);
      if (pinhole.depth[i] < 1e9f) {
        EXPECT_GT(hidden.depth[i], pinhole.depth[i]) << i;
      } else {
        EXPECT_EQ(hidden.depth[i], 1e10f);
      }
    }
    const Truth truth = default_truth(scene, 2), again = default_truth(scene, 2);
    EXPECT_TRUE(is_finite(truth.colour));
    EXPECT_EQ(hash_of(truth.colour), hash_of(again.colour));
  }
}

TEST_P(EachScene, SettingsAreLensesThatCameraJsonKeeps) {
  const Folder folder;
  const Scene scene = make_scene(GetParam(), 97, 53);
  ASSERT_FALSE(scene.settings.empty());
  std::ofstream(folder / "camera.json") << camera_json(scene);
  for (const FocusSetting& setting : scene.settings) {
    const Lens lens = lens_of(scene, setting);
    validate(lens);
    const CameraValues values = read_camera_json(folder / "camera.json", setting.name, 1);
    const Lens read = make_lens(values, 1, LensModel::cg, 0);
    EXPECT_NEAR(background_coc_px(read, 97), background_coc_px(lens, 97), 1e-9);
    EXPECT_EQ(read.focus_distance_units, setting.focus_distance_units);
  }
}

TEST_P(EachScene, HasSomethingInFocusAndSomethingOut) {
  const Scene scene = make_scene(GetParam(), 160, 100);
  const ScenePicture pinhole = render_pinhole(scene);
  double sharpest = 1e9, softest = 0;
  for (const FocusSetting& setting : scene.settings) {
    const double k = background_coc_px(lens_of(scene, setting), 640);
    for (const float z : pinhole.depth) {
      const double coc = k * std::fabs(1 - setting.focus_distance_units / static_cast<double>(z));
      sharpest = std::min(sharpest, coc);
      softest = std::max(softest, coc);
    }
  }
  EXPECT_LT(sharpest, 0.75);
  EXPECT_GT(softest, 2.5);
}

TEST_P(EachScene, AccumulationOfTheLensCentreIsThePinhole) {
  const Scene scene = make_scene(GetParam(), 61, 37);
  const Lens lens = lens_of(scene, scene.settings[0]);
  EXPECT_EQ(hash_of(render_accumulation(scene, lens, {{0, 0}})),
            hash_of(render_pinhole(scene).colour));
  EXPECT_NE(hash_of(render_accumulation(scene, lens, {{0.9, 0}})),
            hash_of(render_pinhole(scene).colour));
}

TEST(Scene, AccumulationIsTheMeanOfItsViews) {
  const Scene scene = make_scene("plate2", 31, 23);
  const Lens lens = lens_of(scene, find_setting(scene, "f3"));
  const auto a = render_accumulation(scene, lens, {{0.5, -0.25}});
  const auto b = render_accumulation(scene, lens, {{-0.75, 0.125}});
  const auto both = render_accumulation(scene, lens, {{0.5, -0.25}, {-0.75, 0.125}});
  for (std::size_t i = 0; i < both[0].size(); ++i) {
    EXPECT_NEAR(both[0][i], (a[0][i] + b[0][i]) / 2, 1e-6);
  }
  expect_error(ErrorKind::usage, {"lens point"}, [&] { render_accumulation(scene, lens, {}); });
}

TEST(Scene, RefusesWhatIsUnknown) {
  expect_error(ErrorKind::usage,
               {"scene 'plat1' is not known", "Did you mean 'plate1'?", "blocks-lake"},
               [] { make_scene("plat1", 64, 48); });
  expect_error(ErrorKind::usage, {"scene size"}, [] { make_scene("plate1", 0, 48); });
  expect_error(ErrorKind::usage, {"scene size"}, [] { make_scene("plate1", 64, 16385); });
  expect_error(ErrorKind::usage, {"scene size"}, [] { make_scene("plate1", 16385, 48); });
  const Scene scene = make_scene("fence", 8, 8);
  expect_error(ErrorKind::usage,
               {"'fence' has no focus setting 'fance'", "Did you mean 'fence'?", "bg"},
               [&] { find_setting(scene, "fance"); });
  expect_error(ErrorKind::usage, {"truth_samples"}, [&] { default_truth(scene, 0); });
  expect_error(ErrorKind::usage, {"truth_samples"}, [&] { default_truth(scene, 65537); });
  expect_error(ErrorKind::usage, {"complexity"}, [] { make_plate2(8, 8, 0); });
}

TEST(Scene, TruthIsSharpInFocus) {
  const Scene scene = make_scene("plate1", 64, 48);
  const ScenePicture pinhole = render_pinhole(scene);
  // The middle of the bar in focus stays as dark as it was: nothing shines through.
  const std::size_t bar = 23 * 64 + 20;
  ASSERT_NEAR(pinhole.depth[bar], 3, 1e-6);
  EXPECT_NEAR(default_truth(scene, 64).colour[0][bar], pinhole.colour[0][bar], 1e-6);
}

TEST(Scene, Plate1IsAsItWas) {
  const ScenePicture pinhole = render_pinhole(make_scene("plate1", 64, 48));
  const auto sum = [](const Plane& plane) {
    return std::accumulate(plane.begin(), plane.end(), 0.0);
  };
  EXPECT_NEAR(sum(pinhole.colour[0]), 1235.8129, 1e-3);
  EXPECT_NEAR(sum(pinhole.colour[1]), 1053.7375, 1e-3);
  EXPECT_NEAR(sum(pinhole.colour[2]), 690.2054, 1e-3);
  EXPECT_NEAR(sum(pinhole.depth), 16788.5625, 1e-3);
}

TEST(Scene, SeedsAndHalvesDiffer) {
  const Scene scene = make_scene("plate1", 33, 21);
  EXPECT_NE(hash_of(default_truth(scene, 8, 1).colour), hash_of(default_truth(scene, 8, 2).colour));
  EXPECT_FALSE(default_truth(scene, 1).noise);
  EXPECT_TRUE(std::isfinite(default_truth(scene, 2).noise->psnr_srgb_db));
}

TEST(Scene, NoiseFallsAsSamplesGrowAndIsWhatItClaims) {
  const Scene scene = make_scene("fence", 67, 41);
  const Truth few = default_truth(scene, 16), many = default_truth(scene, 256);
  // 16 times the samples: 12 dB for random ones, more for strata.
  EXPECT_GT(many.noise->psnr_linear_db, few.noise->psnr_linear_db + 11);
  const Truth best = default_truth(scene, 2048, 9);
  const double off_best_db = compare(few.colour, best.colour, 67).psnr_linear_db;
  EXPECT_NEAR(off_best_db, few.noise->psnr_linear_db + 6, 1.2);
}

/// A white half-plane left of the picture's middle before black.
Scene edge_scene(double depth) {
  Scene scene;
  scene.width = 41;
  scene.height = 1;
  scene.settings = {{"default", 3, 90}};
  scene.primitives.push_back(
      std::make_unique<Rectangle>(-100, -100, 0, 100, depth, plain({1, 1, 1})));
  return scene;
}

/// Share of a disc of radius 1 left of a vertical line at x.
double disc_left_of(double x) {
  if (std::fabs(x) >= 1) return x > 0 ? 1 : 0;
  return 0.5 + (x * std::sqrt(1 - x * x) + std::asin(x)) / std::numbers::pi;
}

TEST(Scene, TruthOfAnEdgeIsTheDiscsIntegral) {
  for (const double depth : {1.6, 2.5, 3.0, 5.0, 40.0}) {
    const Scene scene = edge_scene(depth);
    const Lens lens = lens_of(scene, scene.settings[0]);
    const Plane truth = default_truth(scene, 4096).colour[0];
    const double coc = std::fabs(background_coc_px(lens, 41) * (1 - 3 / depth));
    for (int x = 0; x < 41; ++x) {
      double expected = 0;
      for (int i = 0; i < 64; ++i) {  // over the pixel's width
        const double from_edge = 20.5 - (x + (i + 0.5) / 64);
        expected += disc_left_of(from_edge / std::max(coc, 1e-9)) / 64;
      }
      // 4096 samples in strata: about 1/sqrt(4096 x 64) off, five times that allowed.
      EXPECT_NEAR(truth[static_cast<std::size_t>(x)], expected, 0.01) << depth << " at " << x;
    }
  }
}

TEST(Scene, HiddenLayerIsTheNextSurface) {
  Scene scene = edge_scene(2);
  scene.width = 40;
  scene.primitives.push_back(
      std::make_unique<Rectangle>(-100, -100, 100, 100, 5, plain({0.25, 0.5, 1})));
  scene.background = [](const Vec3&) { return Vec3{3, 3, 3}; };
  const ScenePicture hidden = render_hidden(scene);
  EXPECT_EQ(hidden.depth[0], 5);  // behind the half-plane
  EXPECT_EQ(hidden.colour[1][0], 0.5);
  EXPECT_EQ(hidden.depth[39], 1e10f);  // behind the wall: nothing
  EXPECT_EQ(hidden.colour[1][39], 3);
}

TEST(Scene, ShadowsFallAwayFromTheSun) {
  Scene scene;
  scene.width = scene.height = 41;
  scene.settings = {{"default", 3, 10}};
  scene.light = {normalized({-1, 0, -1}), {1, 1, 1}, {0.1, 0.1, 0.1}, {0.1, 0.1, 0.1}};
  scene.primitives.push_back(
      std::make_unique<Quad>(Vec3{-5, -5, 4}, Vec3{10, 0, 0}, Vec3{0, 10, 0}, plain({1, 1, 1})));
  scene.primitives.push_back(std::make_unique<Ball>(Vec3{0, 0, 3.6}, 0.2, plain({1, 1, 1})));
  const Plane red = render_pinhole(scene).colour[0];
  const auto at = [&](double x) {  // of the wall, in units from the middle
    return red[20 * 41 + static_cast<std::size_t>(20.5 + x / 4 * pixel_focal_length(scene))];
  };
  EXPECT_NEAR(at(0.45), 0.1, 1e-6);                    // the ball's shadow, to the right
  EXPECT_NEAR(at(-0.45), 0.1 + std::sqrt(0.5), 1e-6);  // in the sun
}

TEST(Impulses, LightOnePixelEach) {
  for (const Size size : {Size{640, 480}, {97, 53}, {8, 3}}) {
    const Scene scene = make_scene("impulses", size.width, size.height);
    const ScenePicture pinhole = render_pinhole(scene);
    std::size_t lit = 0;
    for (std::size_t i = 0; i < pinhole.depth.size(); ++i) {
      EXPECT_EQ(pinhole.colour[0][i] > 1, pinhole.depth[i] < 999);
      if (pinhole.colour[0][i] > 1) ++lit;
    }
    EXPECT_EQ(lit, scene.primitives.size() - 1);  // one is the wall
    EXPECT_EQ(lit, size.width > 90 ? 63u : 24u);
  }
}

TEST(Plate2, ComplexityMultipliesItsObjects) {
  const std::size_t room = 2;
  for (const int complexity : {1, 10, 100}) {
    const Scene scene = make_plate2(80, 60, complexity);
    EXPECT_EQ(scene.primitives.size(), 60u * static_cast<std::size_t>(complexity) + room);
    // Where things are does not change: the pictures' depths agree in most pixels.
    const Plane depth = render_pinhole(scene).depth;
    const Plane simple = render_pinhole(make_plate2(80, 60, 1)).depth;
    int alike = 0;
    for (std::size_t i = 0; i < depth.size(); ++i)
      alike += std::fabs(depth[i] / simple[i] - 1) < 0.3;
    EXPECT_GT(alike, 80 * 60 * 8 / 10) << complexity;
  }
}

TEST(Blocks, BlurAsTheEyeModelSays) {
  for (const int width : {640, 1920}) {
    const Scene scene = make_scene("blocks-lake", width, 400);
    const Lens tiny = lens_of(scene, find_setting(scene, "miniature"));
    // Glatzel & Wilhelm: diameter = 28000 px/m x A x 0.017 m / z0 at infinity, 1920 px wide.
    EXPECT_NEAR(2 * background_coc_px(tiny, width), 28000.0 * width / 1920 * 5.75 * 0.017 / 75,
                1e-9);
    const Lens eye = lens_of(scene, find_setting(scene, "normal"));
    EXPECT_NEAR(background_coc_px(tiny, width) / background_coc_px(eye, width), 1250, 1e-6);
  }
}

TEST(Blocks, FocusLiesInTheMiddle) {
  for (const char* name : {"blocks-lake", "blocks-forest"}) {
    const Plane depth = render_pinhole(make_scene(name, 64, 40)).depth;
    Plane middle(depth.begin() + 64 * 19, depth.begin() + 64 * 21);
    std::sort(middle.begin(), middle.end());
    EXPECT_NEAR(middle[middle.size() / 2], 75, 8) << name;
  }
}

}  // namespace
}  // namespace defray::test::scene_test
