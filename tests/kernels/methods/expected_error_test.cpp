// How wrong a picture expects to be, beside how wrong it is.
#include <array>
#include <cmath>
#include <numeric>
#include <set>

#include "kernels/methods/expected_error_support.h"
#include "measure/metrics.h"

namespace defray::test::expected_error_test {
namespace {

double squared_mean(const Plane& rms) {
  return std::inner_product(rms.begin(), rms.end(), rms.begin(), 0.0) /
         static_cast<double>(rms.size());
}

/// Against two truths whose noise has nothing in common, and so without it.
double true_psnr_db(const std::vector<Plane>& picture,
                    const std::array<std::vector<Plane>, 2>& truths) {
  double sum = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t i = 0; i < picture[c].size(); ++i) {
      const double value = shown_value(picture[c][i]);
      sum += (value - shown_value(truths[0][c][i])) * (value - shown_value(truths[1][c][i]));
    }
  }
  return -10 * std::log10(sum / static_cast<double>(3 * picture[0].size()));
}

TEST(ExpectedError, HoldsTheTrueOneOfMostScenes) {
  SKIP_UNLESS_FULL();
  int inside = 0, all = 0;
  for (const std::string& scene : scene_names()) {
    for (const FocusSetting& setting : make_scene(scene, 1, 1).settings) {
      const Subject s = subject_of(scene, setting.name, 120, 80);
      const std::array truths{render_truth(s.scene, s.lens, 36, 1).colour,
                              render_truth(s.scene, s.lens, 36, 2).colour};
      for (const Quality quality : {Quality::preview, Quality::normal}) {
        const ResultWithError result = made(s, chain_of(quality), expects);
        const ExpectedError& e = result.prediction->of_frame();
        const double true_db = true_psnr_db(result.result.colour, truths);
        const bool is_inside = true_db >= e.low_db && true_db <= e.high_db;
        inside += is_inside;
        ++all;
        EXPECT_NEAR(std::accumulate(e.shares.begin(), e.shares.end(), 0.0), 1, 1e-9);
      }
    }
  }
  EXPECT_GE(inside, all * 0.85) << all;  // what the interval says of nine in ten
}

TEST(ExpectedError, IsLargerWhereMoreIsMissing) {
  const Subject s = subject_of("fence", "bg", 160, 104);
  double last = 0;
  for (const Quality quality : {Quality::preview, Quality::draft, Quality::normal}) {
    const double db = made(s, chain_of(quality), expects).prediction->of_frame().psnr_db;
    EXPECT_GT(db, last);
    last = db;
  }
  const ExpectedError hidden = made(s, chain_of(Quality::draft), expects).prediction->of_frame();
  EXPECT_GT(hidden.shares[static_cast<std::size_t>(Cause::hidden)], 0.5);
}

TEST(ExpectedError, OfWhatIsInFocusIsTheDetailOfThePictureItself) {
  Subject s = subject_of("fence", "bg", 96, 64);
  s.coc = Quanta(std::vector<std::int32_t>(s.coc.size()));
  const ExpectedError e = made(s, chain_of(Quality::normal), expects).prediction->of_frame();
  EXPECT_EQ(e.shares[static_cast<std::size_t>(Cause::detail)], 1.0);
  for (Plane& plane : s.pinhole.colour) plane.assign(plane.size(), 0.25f);
  const ExpectedError even = made(s, chain_of(Quality::normal), expects).prediction->of_frame();
  EXPECT_GT(even.psnr_db, 89);
}

TEST(ExpectedError, PlanesAreItsParts) {
  const Subject s = subject_of("spheres", "f2", 120, 80);
  const ResultWithError result = made(s, chain_of(Quality::draft), expects);
  const std::vector<Plane> planes = result.prediction->planes();
  ASSERT_EQ(planes.size(), 1 + cause_count);
  const double all = squared_mean(planes[0]), expected = result.prediction->of_frame().psnr_db;
  EXPECT_NEAR(-10 * std::log10(all), expected, 0.1);
  for (std::size_t c = 0; c < cause_count; ++c) {
    const double share = result.prediction->of_frame().shares[c];
    EXPECT_NEAR(squared_mean(planes[c + 1]) / all, share, 0.03) << c;
    EXPECT_GT(squared_mean(planes[c + 1]), 0.5 * share * all) << c;
  }
  EXPECT_EQ(Prediction::plane_names(),
            (std::vector<std::string>{"total", "sampling", "hidden", "edges", "detail"}));
}

TEST(ExpectedError, IsHighWhereTheErrorIs) {
  // The left half is in focus and even: what is expected there is nothing.
  Subject s = subject_of("fence", "bg", 96, 64);
  std::vector<std::int32_t> coc(s.coc.begin(), s.coc.end());
  for (std::size_t i = 0; i < coc.size(); ++i) {
    if (i % 96 >= 32) continue;
    coc[i] = 0;
    for (Plane& plane : s.pinhole.colour) plane[i] = 0.25f;
  }
  s.coc = coc;
  const ResultWithError result = made(s, chain_of(Quality::normal), expects);
  const Plane total = result.prediction->planes()[0];
  double left = 0, right = 0;
  for (std::size_t i = 0; i < total.size(); ++i) {
    if (i % 96 < 16) left += double{total[i]} * total[i];
    if (i % 96 >= 80) right += double{total[i]} * total[i];
  }
  EXPECT_LT(left, right / 1000);
}

TEST(ExpectedError, IsTheSameForTwinsAndInBands) {
  const Subject s = subject_of("spheres", "f2", 80, 56);
  const ResultWithError by_device = made(s, chain_of(Quality::draft), expects);
  const ResultWithError by_twins = made(s, chain_of(Quality::draft), expects, twins());
  EXPECT_EQ(by_device.prediction->planes(), by_twins.prediction->planes());
  const InBands bands(session(), 1 << 17);
  EXPECT_EQ(made(s, chain_of(Quality::draft), expects).prediction->planes(),
            by_device.prediction->planes());
}

TEST(ExpectedError, OfATallFrameGoesInStripsWithoutSeams) {
  // 300 rows of blocks; what stands in the middle of one strip, and at the end of the other.
  Frame frame{24, 1200, Quanta(std::vector<std::int32_t>(24 * 1200, 8 * 256))};
  frame.depth = Plane(24 * 1200, 2);
  Plane colour(24 * 1200, 0.1f);
  for (const std::size_t y : {100, 500, 900, 1100}) {
    for (std::size_t x = 0; x < 24 * 12; ++x) colour[y * 24 + x] = x % 5 ? 0.8f : 0.2f;
  }
  frame.channels = Planes({colour, colour, colour});
  MethodResult result{{colour, colour, colour}, Plane(colour.size(), 0.5f)};
  result.report.emplace().lens_points = 137;
  const Plane total = Prediction(frame, {}, result, true).planes()[0];
  for (const std::size_t row : {500, 900, 1100}) {
    for (std::size_t i = 0; i < 24 * 90; ++i) {
      ASSERT_NEAR(total[(row - 40) * 24 + i], total[(100 - 40) * 24 + i], 1e-6) << row << " " << i;
    }
  }
}

TEST(ExpectedError, IsNotFoundUnasked) {
  const Subject s = subject_of("spheres", "f2", 32, 24);
  EXPECT_FALSE(made(s, chain_of(Quality::draft), {}).prediction);
  MethodSettings literal;
  EXPECT_FALSE(made(s, literal, {true, false, {}}).prediction);
}

}  // namespace
}  // namespace defray::test::expected_error_test
