// A model's place in the scene.
#include "defray/splat.h"
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

}  // namespace
}  // namespace defray::test::splat_model_test
