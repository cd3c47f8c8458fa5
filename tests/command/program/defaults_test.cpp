// The defaults that `--help` and the README state are those that are used.
#include "command/program.h"

namespace defray::test::defaults_test {
namespace {

std::uint64_t rendered(const Folder& folder, const std::string& options) {
  std::filesystem::remove(folder / "out.exr");
  expect_ok(defray(folder, "render in.exr -o out.exr " + options));
  return file_hash(folder / "out.exr");
}

TEST(Defaults, OfRenderAreThoseThatHelpStates) {
  const Folder folder;
  write_picture_file(folder, "in.exr", {"R", "G", "B", "Z"});
  const std::vector<std::pair<std::string, std::string>> same = {
      {lens, lens + "--method rdb --quality normal --rdb 13 --hidden patterns --split on "
                    "--half-size off --highlights discs --sparse on --border clamp --blades 0 "
                    "--squeeze 1 --cats-eye 0 "
                    "--depth-kind z --unit m --nonfinite zero --lens-model cg --memory 512 "
                    "--math strict --sensor-width 36"},
      {lens + "--quality preview", lens + "--rdb 6 --hidden fill --half-size on"},
      {lens + "--quality draft", lens + "--rdb 9 --hidden fill"},
      {lens + "--literal", lens + "--literal --rdb 9"},
      {lens + "--literal --jitter", lens + "--literal --jitter --seed 0"},
      {lens + "--method gather",
       lens + "--method gather --gather aware --samples 32 --passes 2 --seed 0"},
      {lens + "--blades 5", lens + "--blades 5 --blade-curvature 0 --blade-rotation 0"},
      {"--method tiltshift",
       "--method tiltshift --band-centre 0.5 --band-width 0.2 --max-blur 9.2"},
      {"--eye --focus 3", "--eye=retina --focus 3"},
      {"--eye --focus 3",
       "--focal-length 17 --aperture-diameter 4.6 --pixel-scale 28000 --focus 3"},
      {"--eye=display --focus 3",
       "--eye=display --display-distance 0.6 --display-resolution 3780 --focus 3"},
      {"--eye=display --focus 3",
       "--focal-length 24 --aperture-diameter 4 --pixel-scale 94500 --focus 3"},
  };
  for (const auto& [brief, whole] : same) {
    EXPECT_EQ(rendered(folder, brief), rendered(folder, whole)) << brief << "\n" << whole;
  }
}

TEST(Defaults, OfScenesAreThoseThatHelpStates) {
  const Folder folder;
  const std::string size = " --width 24 --height 18";
  expect_ok(defray(folder, "scene fence --focus-setting bg -o brief" + size));
  expect_ok(defray(folder,
                   "scene fence --focus-setting bg -o whole --truth-samples 256 "
                   "--pinhole-samples 16 --seed 1" +
                       size));
  for (const std::string file : {"/pinhole.exr", "/truth_bg.exr"}) {
    EXPECT_EQ(file_hash(folder / ("brief" + file)), file_hash(folder / ("whole" + file))) << file;
  }
  const Result quiet =
      defray(folder, "scene points -o large --truth-samples 1 --pinhole-samples 1 --quiet");
  expect_ok(quiet);
  EXPECT_EQ(quiet.out + quiet.err, "");
  const ImageFile large = ImageFile::read(folder / "large/pinhole.exr");
  EXPECT_EQ(large.parts()[0].data.width, 640);
  EXPECT_EQ(large.parts()[0].data.height, 480);
}

}  // namespace
}  // namespace defray::test::defaults_test
