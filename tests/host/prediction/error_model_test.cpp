// From signs to decibels.
#include "prediction/error_model.h"

#include <cmath>
#include <numeric>

#include "support.h"

namespace defray::test::error_model_test {
namespace {

TEST(ErrorModel, EverySignAddsToOneCause) {
  EXPECT_EQ(sign_names().size(), sign_count);
  for (std::size_t i = 0; i < sign_count; ++i) {
    SignValues signs{};
    signs[i] = 0.5f;
    const Squares half = squares_of(signs, weights_of({1, false, true}));
    signs[i] = 1;
    const Squares whole = squares_of(signs, weights_of({1, false, true}));
    int causes_of_it = 0;
    for (std::size_t c = 0; c < cause_count; ++c) {
      EXPECT_NEAR(whole[c], 2 * half[c], 1e-12) << i;
      causes_of_it += whole[c] > 0;
    }
    EXPECT_EQ(causes_of_it, 1) << sign_names()[i];
  }
  EXPECT_STREQ(to_string(Cause::sampling), "sampling");
  EXPECT_STREQ(to_string(Cause::detail), "detail");
}

TEST(ErrorModel, WeighsWhatMadeThePicture) {
  const auto all = weights_of({1, false, true}), full = weights_of({1, false, false}),
             patterns = weights_of({1, true, true}), points = weights_of({50, false, true});
  const std::vector<std::string> names = sign_names();
  const auto has = [&](std::size_t i, const char* word) {
    return names[i].find(word) != std::string::npos;
  };
  for (std::size_t i = 0; i < sign_count; ++i) {
    EXPECT_GT(all[i], 0) << names[i];
    EXPECT_EQ(full[i], has(i, "half size") ? 0 : all[i]) << names[i];
    EXPECT_EQ(patterns[i], has(i, "without patterns") ? 0 : all[i]) << names[i];
    EXPECT_EQ(points[i], has(i, "lens points") ? all[i] / 50 : all[i]) << names[i];
  }
}

TEST(ErrorModel, SquaresAreDecibels) {
  EXPECT_NEAR(expected_from(1e-4).psnr_db, 40, 1e-9);
  EXPECT_NEAR(expected_from(1e-3).psnr_db, 30, 1e-9);
  EXPECT_EQ(expected_from(0).psnr_db, most_expected_db);
  const ExpectedError e = expected_from(1e-4);
  EXPECT_LT(e.low_db, 40);
  EXPECT_GT(e.high_db, 40);
}

TEST(ErrorModel, ErrorsGrowFasterThanTheirSigns) {
  const double small = 1e-4 * frame_factor(1e-4), large = 2e-4 * frame_factor(2e-4);
  EXPECT_GT(large, 2 * small);
  EXPECT_LT(large, 3 * small);
  EXPECT_TRUE(std::isfinite(frame_factor(0)));
}

}  // namespace
}  // namespace defray::test::error_model_test
