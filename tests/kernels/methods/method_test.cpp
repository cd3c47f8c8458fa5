// What every method must do: leave sharp pictures alone, keep light where it is.
#include "methods/method.h"

#include <cmath>

#include "methods/tiltshift.h"
#include "reference/reference.h"
#include "scenes/geometry/primitives.h"
#include "scenes/tracing/render.h"
#include "support.h"

namespace defray::test::method_test {
namespace {

/// Every method and kind, with a name for messages.
std::vector<std::pair<std::string, MethodSettings>> all_methods() {
  std::vector<std::pair<std::string, MethodSettings>> all;
  const auto add = [&](const std::string& name, Method method, GatherKind kind, bool rotate) {
    MethodSettings s;
    s.method = method;
    s.rdb.jitter = rotate;
    s.gather.kind = kind;
    s.gather.rotate = rotate;
    all.emplace_back(name + (rotate ? ", randomised" : ""), s);
  };
  add("linear", Method::linear, {}, false);
  for (const bool rotate : {false, true}) {
    add("rdb", Method::rdb, {}, rotate);
    add("literal gather", Method::gather, GatherKind::literal, rotate);
    add("aware gather", Method::gather, GatherKind::aware, rotate);
  }
  return all;
}

TEST(Method, ClosedApertureReturnsTheInputBitForBit) {
  const Size size{37, 23};
  const Plane depth = random_depth(size, 1);
  const std::vector<std::int32_t> coc(depth.size());
  std::vector<Plane> colour;
  for (std::uint32_t c = 0; c < 3; ++c) colour.push_back(random_plane(size, c));
  for (const auto& [name, settings] : all_methods()) {
    for (Backend* s : device_and_twins()) {
      EXPECT_EQ(hash_of(apply_method({37, 23, coc, depth, colour}, settings, *s).colour),
                hash_of(colour))
          << name << (s ? "" : ", twin");
    }
  }
}

TEST(Method, ImpulsesKeepTheirCentroid) {
  const int side = is_slow_device() ? 17 : 61, middle = side / 2;
  for (const double radius : {0.6, 2.3, 11.0}) {
    if (radius > 3 && is_slow_device()) continue;
    const Plane depth(side * side, 4.0f);
    const std::vector<std::int32_t> coc(depth.size(), std::lround(256 * radius));
    Plane impulse(depth.size());
    impulse[middle * side + middle] = 100;
    for (const auto& [name, settings] : all_methods()) {
      // Turned or shifted samples differ from pixel to pixel: their noise moves a single impulse.
      if (name.find("random") != std::string::npos) continue;
      const Plane out =
          apply_method({side, side, coc, depth, {impulse}}, settings, device()).colour[0];
      double sum = 0, x = 0, y = 0;
      for (int i = 0; i < side * side; ++i) {
        sum += out[i], x += out[i] * (i % side - middle), y += out[i] * (i / side - middle);
      }
      ASSERT_GT(sum, 0) << name;
      EXPECT_NEAR(x / sum, 0, 0.01) << name << ", radius " << radius;
      EXPECT_NEAR(y / sum, 0, 0.01) << name << ", radius " << radius;
    }
  }
}

TEST(Method, TiltshiftKeepsFlatAreasFlat) {
  const auto coc = twins().tiltshift(tiltshift_params({0.5, 0.3, 12}, 40, 60, 0, 60));
  const std::vector<Plane> grey{Plane(40 * 60, 0.5f)};
  MethodSettings settings;
  settings.method = Method::tiltshift;
  for (Backend* s : device_and_twins()) {
    const Plane out = apply_method({40, 60, coc, {}, grey}, settings, *s).colour[0];
    // 25 x 25 additions each of light and weight.
    for (const float value : out) ASSERT_NEAR(value, 0.5f, 2 * 625 * 0x1p-24);
  }
}

/// A waving plane 4 m away, focused at 2 m: one CoC, no occlusion.
Scene waves() {
  Scene scene;
  scene.width = 80, scene.height = 60;
  scene.focal_length_mm = 50, scene.sensor_width_mm = 36;
  scene.settings = {{"default", 2, 540}};
  const auto colour = [](const Vec3& p) {
    const double wave = 0.5 + 0.25 * std::sin(9 * p.x) + 0.2 * std::cos(11 * p.y + 3 * p.x);
    return Vec3{wave, 0.5 * wave, 1 - wave};
  };
  scene.primitives.push_back(std::make_unique<Rectangle>(-9, -9, 9, 9, 4, colour));
  return scene;
}

TEST(Method, ConstantDepthGivesOnePictureFromAllOfThem) {
  if (is_slow_device()) GTEST_SKIP() << "855 cells";
  const Scene scene = waves();
  const Lens lens = lens_of(scene, scene.settings[0]);
  const ScenePicture pinhole = render_pinhole(scene);
  const auto coc = device().coc(lens, scene.width, pinhole.depth);
  // Vogel's spiral fills the disc evenly: the integral over the lens to about 1/count.
  std::vector<std::array<double, 2>> points;
  for (int i = 0; i < 4000; ++i) {
    const double r = std::sqrt((i + 0.5) / 4000), angle = 2.399963229728653 * i;
    points.push_back({r * std::cos(angle), r * std::sin(angle)});
  }
  const std::vector<Plane> truth = render_accumulation(scene, lens, points);
  MethodSettings linear, rdb, aware;
  linear.method = Method::linear;
  rdb.rdb.cells_per_side = 33;
  aware.method = Method::gather;
  aware.gather.samples = 1024;
  aware.gather.passes = 1;
  for (const auto& [settings, tolerance] :
       {std::pair{linear, 0.004}, {rdb, 0.004}, {aware, 0.008}}) {
    const auto out =
        apply_method({80, 60, coc, pinhole.depth, pinhole.colour}, settings, device()).colour;
    double worst = 0, blur = 0;
    for (int y = 10; y < 50; ++y) {  // borders: each method's own policy
      for (int x = 10; x < 70; ++x) {
        worst = std::fmax(worst, std::fabs(out[0][y * 80 + x] - truth[0][y * 80 + x]));
        blur = std::fmax(blur, std::fabs(pinhole.colour[0][y * 80 + x] - truth[0][y * 80 + x]));
      }
    }
    EXPECT_LE(worst, tolerance) << "method " << static_cast<int>(settings.method);
    EXPECT_GT(blur, 20 * tolerance);  // the picture is far from sharp
  }
}

TEST(Method, TwinsGiveTheSamePicture) {
  const Size size{23, 29};
  const Plane depth = random_depth(size, 1);
  const auto coc = random_coc(size, 4, 2);
  const std::vector<Plane> colour{random_plane(size, 3)};
  for (const auto& [name, settings] : all_methods()) {
    const Frame frame{23, 29, coc, depth, colour};
    const Plane kernel = apply_method(frame, settings, device()).colour[0];
    const Plane twin = apply_method(frame, settings, twins()).colour[0];
    // Only the RDB's twin works in double; its bound is in rdb_test.
    const double tolerance = settings.method == Method::rdb ? 64 * 150 * 0x1p-24 : 0;
    for (std::size_t i = 0; i < twin.size(); ++i)
      ASSERT_NEAR(kernel[i], twin[i], tolerance) << name;
  }
}

}  // namespace
}  // namespace defray::test::method_test
