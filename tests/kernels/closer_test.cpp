// The RDB with its stages is never farther from the truth than Shinya's method alone, on any
// built-in scene.
#include <algorithm>
#include <cmath>

#include "scenes/subject.h"
#include "support.h"

namespace defray::test {
namespace {

struct Case {
  std::string scene, setting;
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.scene << " " << c.setting; }

std::vector<Case> all_cases() {
  std::vector<Case> cases;
  for (const std::string& name : scene_names()) {
    for (const FocusSetting& setting : make_scene(name, 8, 8).settings) {
      cases.push_back({name, setting.name});
    }
  }
  return cases;
}

class Closer : public testing::TestWithParam<Case> {};

/// Root mean square of a PSNR, 1 is the largest value.
double rms_of(double psnr_db) { return std::pow(10, -psnr_db / 20); }

TEST_P(Closer, ThanTheLiteralRdb) {
  const auto [name, setting] = GetParam();
  if (name != "fence" && name != "spheres") SKIP_UNLESS_FULL();
  const int width = 160, height = 120;
  Subject s = make_subject(device(), make_scene(name, width, height), setting);
  s.pinhole.colour = render_pinhole(s.scene, {64}).colour;  // as productions have it
  const Truth truth = render_truth(s.scene, s.lens, 144, 1);
  const auto rms = [&](const MethodSettings& settings) {
    return rms_of(compare(render(device(), s, settings), truth.colour, width).psnr_srgb_db);
  };
  MethodSettings with_stages;
  with_stages.chain = ChainSettings{};
  const double literal = rms({}), whole = rms(with_stages);
  // The mean of the truth's two halves is twice as near the truth as they are to each other.
  const double noise = rms_of(truth.noise->psnr_srgb_db) / 2;
  RecordProperty("literal_db", std::to_string(-20 * std::log10(literal)));
  RecordProperty("default_db", std::to_string(-20 * std::log10(whole)));
  RecordProperty("truth_db", std::to_string(-20 * std::log10(noise)));
  EXPECT_LE(whole, literal + noise);
}

std::string name_of(const testing::TestParamInfo<Case>& info) {
  std::string name = info.param.scene + "_" + info.param.setting;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(BuiltIn, Closer, testing::ValuesIn(all_cases()), name_of);

}  // namespace
}  // namespace defray::test
