// Channels beside the colour: which go through the lens together.
#include "image/further_channels.h"

#include "image/image_file.h"
#include "support.h"

namespace defray::test::further_channels_test {
namespace {

std::vector<LightGroup> light(std::vector<std::string> names) {
  const std::vector<std::string> colour{"R", "G", "B"};
  names.insert(names.end(), colour.begin(), colour.end());
  const ImageFile file = ImageFile::from_planes(names, std::vector<Plane>(names.size(), Plane(4)),
                                                2, 2, Sample::single_float);
  return choose_further(file, choose_colour("f.exr", file.parts(), {}), {"*.*"}).light;
}

TEST(LightGroups, HaveAlphaWhereItIsTheirLast) {
  const auto with = light({"diffuse.R", "diffuse.G", "diffuse.B", "diffuse.A"});
  ASSERT_EQ(with.size(), 1u);
  EXPECT_TRUE(with[0].has_alpha);
  const auto without = light({"diffuse.R", "diffuse.G", "diffuse.B"});
  ASSERT_EQ(without.size(), 1u);
  EXPECT_FALSE(without[0].has_alpha);
  const auto alone = light({"holdout.A"});
  ASSERT_EQ(alone.size(), 1u);
  EXPECT_FALSE(alone[0].has_alpha);
}

}  // namespace
}  // namespace defray::test::further_channels_test
