// defray psf as a user runs it.
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "command/program.h"
#include "image/ldr.h"
#include "reference/reference.h"

namespace defray::test::psf_command_test {
namespace {

using nlohmann::json;

const std::string base = "psf --focal-length 50 --focus 3 --fstop 2.8 ";

class PsfCommand : public testing::Test {
 protected:
  json measured(const std::string& arguments) {
    const Result result = defray(folder_, arguments + " --json");
    EXPECT_EQ(result.code, 0) << arguments << "\n" << result.err;
    return json::parse(result.out);
  }

  void refuse(const std::string& arguments, int code, const std::vector<std::string>& words) {
    expect_refusal(defray(folder_, arguments), code, words, arguments);
  }

  Folder folder_;
};

TEST_F(PsfCommand, CocIsTheOneThatRenderUses) {
  Lens lens;
  lens.focus_distance_units = 3;
  lens.model = LensModel::breathing;
  const double radius = reference::coc_px(lens, 1920, 4);
  const json report = measured(base + "--depth 4");
  EXPECT_NEAR(report["coc_diameter_px"].get<double>(), 2 * radius, 1e-9);
  EXPECT_NEAR(report["pixel_um"].get<double>(), 18.75, 1e-9);
  ASSERT_EQ(report["wavelengths"].size(), 3u);
  // Options change what they should: half the pixels, half the sensor and half the aperture.
  EXPECT_NEAR(measured(base + "--depth 4 --width 960")["coc_diameter_px"].get<double>(), radius,
              1e-9);
  EXPECT_NEAR(measured(base + "--depth 4 --sensor-width 18")["coc_diameter_px"].get<double>(),
              4 * radius, 1e-9);
  EXPECT_NEAR(measured("psf --focal-length 50 --focus 3 --depth 4 --aperture-diameter " +
                       std::to_string(25 / 2.8))["coc_diameter_px"]
                  .get<double>(),
              radius, 1e-6);
}

TEST_F(PsfCommand, ACameraFileGivesTheLens) {
  std::ofstream(folder_ / "camera.json")
      << R"({"focal_length_mm": 50, "focus_settings": {"a": {"focus_distance_m": 3, "f_stop": 2.8},
                                                       "b": {"focus_distance_m": 3, "f_stop": 8}}})";
  const json typed = measured(base + "--depth 4");
  EXPECT_EQ(measured("psf --depth 4 --camera camera.json --focus-setting a"), typed);
  EXPECT_EQ(measured("psf --depth 4 --camera camera.json --focus-setting b --fstop 2.8"), typed);
  EXPECT_NE(measured("psf --depth 4 --camera camera.json --focus-setting b"), typed);
  refuse("psf --depth 4 --camera camera.json", 3, {"--focus-setting"});
  refuse("psf --depth 4 --focus-setting a", 2, {"--focus-setting goes with --camera"});
  refuse("psf --depth 4 --camera camera.json --focus-setting a --csv ./camera.json", 2,
         {"input and output at once"});
}

TEST_F(PsfCommand, WritesAChartAndATable) {
  const Result result =
      defray(folder_, base + "--depth 4 -o a.png --csv a.csv --wavelength 500,600");
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_NE(result.out.find("geometric CoC diameter 4.036 px"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("500 nm: Airy diameter 3.473 um = 0.1852 px"), std::string::npos)
      << result.out;
  EXPECT_NE(result.out.find("diffraction does not matter here"), std::string::npos) << result.out;
  std::ifstream table(folder_ / "a.csv");
  std::string header, first, last;
  std::getline(table, header);
  EXPECT_EQ(header, "radius_px,radius_um,geometric,broadband,500nm,600nm");
  std::getline(table, first);
  EXPECT_EQ(first.rfind("0,0,", 0), 0u) << first;
  EXPECT_EQ(std::count(first.begin(), first.end(), ','), 5);
  const LdrPicture linear = read_ldr(folder_ / "a.png");
  EXPECT_EQ(linear.width, 1000);
  ASSERT_EQ(defray(folder_, base + "--depth 4 -o log.png --log --wavelength 500,600").code, 0);
  EXPECT_NE(hash_of(read_ldr(folder_ / "log.png").planes), hash_of(linear.planes));
}

TEST_F(PsfCommand, InFocusThereIsOnlyTheAiryPattern) {
  for (const std::string& lens :
       {std::string("--focus 3 --depth 3"), std::string("--focus inf --depth inf")}) {
    const json report =
        measured("psf --focal-length 50 --fstop 22 --wavelength 550 -o focus.png " + lens);
    EXPECT_EQ(report["coc_diameter_px"], 0) << lens;
    EXPECT_TRUE(report["diffraction_matters"]) << lens;
  }
  // 2.44 lambda N with the sensor at the focal plane.
  const json report = measured("psf --focal-length 50 --fstop 8 --focus inf --depth inf");
  EXPECT_NEAR(report["wavelengths"][1]["airy_diameter_um"].get<double>(), 2.44 * 0.55 * 8, 0.01);
  EXPECT_GT(measured("psf --focal-length 50 --fstop 8 --focus inf --depth 10")["coc_diameter_px"],
            1);
  EXPECT_GT(measured(base + "--depth inf")["coc_diameter_px"], 1);
}

TEST_F(PsfCommand, RefusesImpossibleLenses) {
  refuse("psf --depth 4", 2, {"--focus, --focal-length, --fstop or --aperture-diameter"});
  refuse("psf --focus 3 --fstop 2.8 --focal-length 50", 2, {"--depth is missing"});
  refuse(base + "--depth 0", 2, {"--depth is 0"});
  refuse(base + "--depth 4 --aperture-diameter 3", 2, {"the same thing"});
  refuse("psf --focus 3 --focal-length 50 --depth 4 --aperture-diameter 0", 2, {"no PSF"});
  refuse("psf --focus 3 --focal-length 50 --depth 4 --fstop 0", 2, {"f-number is 0"});
  refuse("psf --focus 0.04 --focal-length 50 --depth 4 --fstop 2", 2, {"inside the focal length"});
  refuse(base + "--depth 4 --width 1 --sensor-width 1e9", 2, {"does not converge"});
  refuse(base + "--depth 1e-9", 2, {"does not converge", "Fresnel zones"});
}

TEST_F(PsfCommand, RefusesImpossibleWavelengthsAndOutputs) {
  refuse(base + "--depth 4 --wavelength 550,50", 2, {"--wavelength is 50 nm", "100 to 20000"});
  refuse(base + "--depth 4 --wavelength green", 2, {"green"});
  refuse(base + "--depth 4 -o psf.exr", 2, {"psf.exr", "PNG or JPEG"});
  refuse(base + "--depth 4 -o none/psf.png", 4, {"none/psf.png"});
  refuse(base + "--depth 4 --csv none/psf.csv", 4, {"none/psf.csv"});
  refuse(base + "--depth 4 -o a.png --csv a.png", 2, {"the same file"});
  refuse(base + "--depth 4 -o ''", 2, {"--output", "is empty"});
  refuse(base + "--depth 4 --csv ''", 2, {"--csv", "is empty"});
  refuse(base + "--depth 4 --camera ''", 2, {"--camera", "is empty"});
  refuse(base + "--depth 4 --log", 2, {"--log requires --output"});
}

}  // namespace
}  // namespace defray::test::psf_command_test
