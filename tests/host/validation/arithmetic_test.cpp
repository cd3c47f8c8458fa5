// 'defray validate --arithmetic': every variant with every method, against the strict build.
#include "validation/arithmetic.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "support.h"

namespace defray::test::arithmetic_test {
namespace {

using namespace defray::validation;

const std::vector<VariantResult>& measured() {
  static const std::vector<VariantResult> results =
      measure_arithmetic(device_under_test(), 64, 48, 1, Level::tiny);
  return results;
}

TEST(Arithmetic, EveryVariantRunsWithEveryMethodAndKernel) {
  SKIP_UNLESS_FULL();
  ASSERT_EQ(measured().size(), variants().size());
  for (const VariantResult& r : measured()) {
    EXPECT_EQ(r.error, "") << r.name;
    EXPECT_EQ(r.methods.size(), 4u) << r.name;
    EXPECT_EQ(r.kernels.kernels.size(), kernel_checks().size()) << r.name;
    EXPECT_FALSE(r.kernel_time_ratio.empty()) << r.name;
    for (const MethodFigures& m : r.methods) {
      EXPECT_GT(m.time_ratio, 0) << r.name << " " << m.method;
      EXPECT_GT(m.psnr_db, 50) << r.name << " " << m.method;
    }
  }
}

TEST(Arithmetic, StrictIsFirstAndIsWhatTheOthersAreComparedWith) {
  SKIP_UNLESS_FULL();
  const VariantResult& strict = measured().front();
  EXPECT_EQ(strict.name, "strict");
  EXPECT_TRUE(strict.kernels.passed());
  for (const MethodFigures& m : strict.methods) {
    EXPECT_EQ(m.time_ratio, 1) << m.method;
    EXPECT_TRUE(std::isinf(m.psnr_db)) << m.method;
    EXPECT_EQ(m.changed, 0) << m.method;
    EXPECT_TRUE(m.is_stable) << m.method;
  }
}

TEST(Arithmetic, FastChangesThePicturesAndSaysByHowMuch) {
  SKIP_UNLESS_FULL();
  const VariantResult& fast = measured()[2];
  ASSERT_EQ(fast.name, "fast");
  EXPECT_GT(fast.methods[0].changed, 0);
  EXPECT_GT(fast.methods[0].psnr_db, 100);
  EXPECT_TRUE(std::isfinite(fast.methods[0].psnr_db));
}

TEST(Arithmetic, ReportHasWhatWasMeasured) {
  SKIP_UNLESS_FULL();
  const auto list = nlohmann::json::parse(to_json(measured()));
  ASSERT_EQ(list.size(), variants().size());
  for (std::size_t v = 0; v < list.size(); ++v) {
    EXPECT_EQ(list[v]["variant"], variants()[v].name);
    ASSERT_EQ(list[v]["methods"].size(), 4u);
    EXPECT_EQ(list[v]["kernels"].size(), kernel_checks().size());
  }
  EXPECT_TRUE(list[0]["methods"][0]["psnr_srgb_db"].is_null());
  EXPECT_TRUE(list[2]["methods"][0]["psnr_srgb_db"].is_number());
  const Folder folder;
  const Section section = to_section(measured(), folder.path());
  EXPECT_EQ(section.findings.size(), variants().size());
  EXPECT_EQ(section.tables[0].rows.size(), 4 * variants().size());
  EXPECT_TRUE(std::filesystem::exists(folder / section.figures.at(0).file));
}

}  // namespace
}  // namespace defray::test::arithmetic_test
