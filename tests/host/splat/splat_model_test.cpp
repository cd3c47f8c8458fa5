// A model's place in the scene.
#include <cmath>

#include "defray/splat.h"
#include "splat/view.h"
#include "support.h"

namespace defray::test::splat_model_test {
namespace {

TEST(SplatModel, IsWhereItsCloudsOriginPutsIt) {
  PointCloud moved = make_point_cloud("figure", 500);
  for (double& along : moved.origin) along += 1e6;
  const auto here = SplatModel(make_point_cloud("figure", 500)).centre();
  const auto there = SplatModel(moved).centre();
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(there[i] - here[i], 1e6, 1e-6);
}

/// All points are in the picture that is taken without a view, whatever its shape, and fill much of
/// it.
TEST(SplatModel, TheDefaultViewShowsAllOfIt) {
  for (const char* name : {"plane", "figure", "crossing", "mask"}) {
    const PointCloud cloud = make_point_cloud(name, 3000);
    const SplatModel model(cloud);
    for (const auto& [width, height] : {std::pair{300, 300}, {400, 100}, {100, 400}}) {
      SplatSettings settings;
      settings.width = width;
      settings.height = height;
      Lens lens;
      lens.focus_distance_units = 3;
      const DefraySplatParams p =
          splat_params(framing_pose(model, lens, settings), cloud.origin, lens, settings);
      double widest = 0;
      for (const auto& at : cloud.positions) {
        const double z = static_cast<double>(p.eye_z - at[2]);
        ASSERT_GT(z, static_cast<double>(p.near_units));
        const double focal = static_cast<double>(p.focal_px);
        const double x = focal * static_cast<double>(at[0] - p.eye_x) / z;
        const double y = focal * static_cast<double>(at[1] - p.eye_y) / z;
        widest = std::max({widest, std::abs(2 * x / width), std::abs(2 * y / height)});
      }
      EXPECT_LT(widest, 1) << name << " in " << width << "x" << height;
      EXPECT_GT(widest, 0.35) << name << " in " << width << "x" << height;
    }
  }
}

}  // namespace
}  // namespace defray::test::splat_model_test
