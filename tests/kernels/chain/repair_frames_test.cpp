// Which frames' depth the chain repairs.
#include <cmath>

#include "base/random.h"
#include "chain/chain.h"
#include "scenes/subject.h"
#include "support.h"

namespace defray::test::repair_frames_test {
namespace {

/// Pixels that the chain repairs of a built-in scene's picture.
std::size_t repaired(const std::string& scene, int width, int height, bool is_antialiased) {
  Subject s = make_subject(device(), make_scene(scene, width, height),
                           make_scene(scene, 8, 8).settings[0].name);
  s.pinhole.colour = render_pinhole(s.scene, {16, false}).colour;
  if (is_antialiased) s.pinhole.depth = render_pinhole(s.scene, {16, true}).depth;
  s.coc = device().coc(s.lens, width, s.pinhole.depth);
  ChainSettings settings;
  settings.hidden = Hidden::off;
  RdbSettings rdb;
  rdb.cells_per_side = 2;
  return run_chain(s.frame(), settings, device()).report->repaired;
}

TEST(Repair, IsDoneWhereDepthWasAntialiasedAndNotForRimsOfRoundThings) {
  if (is_slow_device()) GTEST_SKIP() << "whole pictures";
  for (const auto& [scene, width] :
       {std::pair{"plate1", 640}, {"plate2", 320}, {"spheres", 320}, {"drift", 320}}) {
    if (width > 320 && !takes_long_tests()) continue;
    EXPECT_EQ(repaired(scene, width, width * 3 / 4, false), 0u) << scene;
    EXPECT_GT(repaired(scene, width, width * 3 / 4, true), 100u) << scene;
  }
}

/// Blades of grass at all depths before a wall, some thinner than a pixel, 16 rays a pixel.
class Grass {
 public:
  static constexpr int width = 200, height = 120, rays = 4, fine = width * rays;

  Grass() : depth_(fine * height * rays, 8.0f), colour_(depth_.size()) {
    for (std::size_t i = 0; i < depth_.size(); ++i) colour_[i] = 0.3f;
    for (int blade = 0; blade < 150; ++blade) draw(blade);
  }

  /// Right of column `sharp_from` depth is that of pixels' middles.
  Frame frame(int sharp_from) const {
    Plane depth, colour;
    std::vector<std::int32_t> coc;
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        colour.push_back(mean(colour_, x, y));
        depth.push_back(x < sharp_from ? mean(depth_, x, y) : depth_[at(4 * x + 2, 4 * y + 2)]);
        coc.push_back(static_cast<std::int32_t>(256 * 12 * (depth.back() - 3) / depth.back()));
      }
    }
    return {width, height, coc, depth, {colour}};
  }

 private:
  static std::size_t at(int x, int y) { return static_cast<std::size_t>(y * fine + x); }

  /// Later ones are nearer.
  void draw(int blade) {
    Random random(blade, 0, 1);
    const double root = fine * random.next(), slope = 0.6 * random.next() - 0.3;
    const double wide = rays * (0.7 + 2 * random.next()), top = height * rays * random.next();
    const double shade = random.next();
    for (int y = static_cast<int>(top); y < height * rays; ++y) {
      for (int x = 0; x < fine; ++x) {
        if (std::abs(x - root - slope * (height * rays - y)) > wide / 2) continue;
        depth_[at(x, y)] = static_cast<float>(6 - blade / 30.0);
        colour_[at(x, y)] = static_cast<float>(shade);
      }
    }
  }

  static float mean(const Plane& plane, int x, int y) {
    float sum = 0;
    for (int i = 0; i < rays * rays; ++i) sum += plane[at(4 * x + i % 4, 4 * y + i / 4)];
    return sum / (rays * rays);
  }

  Plane depth_, colour_;
};

/// Thin things at depths between others' look like anti-aliased depth; their colours do not.
TEST(Repair, ThinThingsOfSharpDepthStay) {
  const auto moved = [](const Frame& f) {
    ChainSettings settings;
    settings.hidden = Hidden::off;
    return run_chain(f, settings, device()).report->repaired;
  };
  const Grass grass;
  const Frame sharp = grass.frame(0), smooth = grass.frame(Grass::width);
  std::size_t between = 0, mixed = 0;
  for (const std::uint32_t ramp : device().repair(sharp)) between += ramp != 0;
  for (const std::uint32_t m : device().mixed(sharp)) mixed += m;
  EXPECT_GT(between * 20, mixed) << "as many as of anti-aliased depth";
  EXPECT_EQ(moved(sharp), 0u);
  EXPECT_GT(moved(smooth), 500u);
}

}  // namespace
}  // namespace defray::test::repair_frames_test
