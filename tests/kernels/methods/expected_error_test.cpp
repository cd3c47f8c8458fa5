// How wrong a picture expects to be, beside how wrong it is, and what a target makes of it.
#include <array>
#include <cmath>
#include <numeric>
#include <set>

#include "measure/metrics.h"
#include "prediction/with_error.h"
#include "scenes/subject.h"
#include "support.h"

namespace defray::test::expected_error_test {
namespace {

/// Colour anti-aliased.
Subject subject_of(const std::string& scene, const std::string& setting, int width, int height) {
  Subject s = make_subject(device(), make_scene(scene, width, height), setting);
  s.pinhole.colour = render_pinhole(s.scene, {64}).colour;
  return s;
}

MethodSettings chain_of(Quality quality) {
  MethodSettings settings;
  settings.chain = settings_for(quality);
  return settings;
}

ResultWithError made(const Subject& s, const MethodSettings& settings, const ErrorSettings& error,
                     Backend& backend = device()) {
  return apply_with_error(s.frame(), settings, error, backend, false, {});
}

const ErrorSettings expects{true, true, {}};

ErrorSettings target(double db) { return {false, false, db}; }

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

TEST(Target, TakesTheFastestQualityThatMeetsIt) {
  const Subject s = subject_of("fence", "bg", 160, 104);
  std::vector<double> expected;
  for (const Quality quality : {Quality::preview, Quality::draft, Quality::normal, Quality::high}) {
    expected.push_back(made(s, chain_of(quality), expects).prediction->of_frame().psnr_db);
  }
  MethodSettings settings = chain_of(Quality::high);
  settings.chain->repair = false;  // not a quality's own: stays
  const ResultWithError fast = made(s, settings, target(1));
  EXPECT_EQ(fast.rung, rungs().front());
  EXPECT_TRUE(fast.settings.chain->half_size);
  EXPECT_FALSE(fast.settings.chain->repair);
  settings.chain->repair = true;
  for (std::size_t q = 0; q < 3; ++q) {
    if (expected[q + 1] < expected[q] + 0.02) continue;
    const ResultWithError next = made(s, settings, target(expected[q] + 0.01));
    const auto reached = next.expected(target(expected[q] + 0.01));
    EXPECT_FALSE(reached->misses_target);
    // No more than the next quality, the least that stood there before: what lies between is tried.
    const auto rank = [](const Rung& rung) {
      return std::find(rungs().begin(), rungs().end(), rung) - rungs().begin();
    };
    const auto quality = static_cast<Quality>(q + 1);
    EXPECT_LE(rank(*next.rung), rank({quality, settings_for(quality).cells_per_side})) << q;
    EXPECT_EQ(reached->quality, next.rung->quality);
    EXPECT_EQ(reached->cells_per_side, next.rung->cells_per_side);
    MethodSettings by_hand = chain_of(next.rung->quality);
    by_hand.chain->cells_per_side = next.rung->cells_per_side;
    EXPECT_EQ(next.result.colour, made(s, by_hand, {}).result.colour);
  }
}

TEST(Target, OutOfReachIsSaidOfTheBest) {
  const Subject s = subject_of("fence", "bg", 96, 64);
  std::vector<double> shares;
  const ResultWithError result =
      apply_with_error(s.frame(), chain_of(Quality::normal), target(80), device(), false,
                       [&](double share) { shares.push_back(share); });
  EXPECT_EQ(result.rung, rungs().back());
  EXPECT_TRUE(result.expected(target(80))->misses_target);
  EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
  EXPECT_EQ(shares.back(), 1.0);
  // After preview, which tells of no progress, the default, whose word on the others is good; the
  // best.
  std::set<std::size_t> tried;
  for (const double share : shares) {
    const double rung = share * static_cast<double>(rungs().size());
    if (rung != std::floor(rung)) tried.insert(static_cast<std::size_t>(rung));
  }
  const auto normal = std::find(rungs().begin(), rungs().end(), Rung{Quality::normal, 13});
  EXPECT_EQ(tried, (std::set<std::size_t>{static_cast<std::size_t>(normal - rungs().begin()),
                                          rungs().size() - 1}));
}

TEST(Target, BetweenTheDefaultAndHighTakesWhatLiesBetween) {
  const Subject s = subject_of("plate2", "f1", 160, 104);
  const auto expected_db = [&](Quality quality) {
    return made(s, chain_of(quality), expects).prediction->of_frame().psnr_db;
  };
  const double normal = expected_db(Quality::normal), high = expected_db(Quality::high);
  ASSERT_GT(high, normal + 0.1);
  const double wanted = normal + 0.3 * (high - normal);
  const ResultWithError result = made(s, chain_of(Quality::normal), target(wanted));
  EXPECT_GE(result.prediction->of_frame().psnr_db, wanted);
  EXPECT_EQ(result.rung->quality, Quality::normal);
  EXPECT_GT(result.rung->cells_per_side, 13);
  EXPECT_LT(result.rung->cells_per_side, 25);
}

/// Of a sequence: the frame before says where to begin, and its quality is left for much less only.
TEST(Target, ASequencesFrameBeginsWithWhatDidBefore) {
  const Subject s = subject_of("fence", "bg", 160, 104);
  const MethodSettings settings = chain_of(Quality::normal);
  const auto at = [&](const Rung& rung) {
    MethodSettings by_hand = chain_of(rung.quality);
    by_hand.chain->cells_per_side = rung.cells_per_side;
    return made(s, by_hand, expects).prediction->of_frame().psnr_db;
  };
  ErrorSettings wanted = target(at({Quality::normal, 11}) - 0.001);
  const auto beginning_with = [&](const Rung& rung) {
    wanted.first_quality = rung.quality;
    wanted.first_cells_per_side = rung.cells_per_side;
    return made(s, settings, wanted);
  };
  // What does is kept, though a little less would do.
  const ResultWithError kept = beginning_with({Quality::normal, 13});
  EXPECT_EQ(kept.rung, (Rung{Quality::normal, 13}));
  EXPECT_EQ(kept.next_rung, kept.rung);
  EXPECT_EQ(kept.expected(wanted)->next_quality, Quality::normal);
  EXPECT_EQ(kept.expected(wanted)->next_cells_per_side, 13);
  // What is far too much makes this frame, and the next one takes less.
  const ResultWithError high = beginning_with(rungs().back());
  EXPECT_EQ(high.rung, rungs().back());
  EXPECT_EQ(high.next_rung->quality, Quality::normal);
  EXPECT_LT(high.next_rung->cells_per_side, 18);
  // What does not do is left at once.
  const ResultWithError raised = beginning_with({Quality::draft, 7});
  EXPECT_GE(raised.prediction->of_frame().psnr_db, *wanted.target_db);
  // What there is not is the beginning.
  EXPECT_EQ(beginning_with({Quality::draft, 64}).rung,
            made(s, settings, target(*wanted.target_db)).rung);
}

TEST(Target, OfNoUseIsRefused) {
  const MethodSettings chain = chain_of(Quality::normal);
  MethodSettings literal, gather = chain;
  gather.method = Method::gather;
  for (const double db : {0.0, -3.0, 90.5, HUGE_VAL, static_cast<double>(NAN)}) {
    expect_error(ErrorKind::usage, {"target_db", "90"}, [&] { validate(chain, target(db)); });
  }
  for (const MethodSettings& settings : {literal, gather}) {
    expect_error(ErrorKind::usage, {"target_db", "stages"},
                 [&] { validate(settings, target(40)); });
  }
  for (const auto change : std::vector<void (*)(ChainSettings&)>{
           [](ChainSettings& s) { s.border = Border::black; },
           [](ChainSettings& s) { s.border = Border::renormalise; },
           [](ChainSettings& s) { s.split = false; },
           [](ChainSettings& s) { s.highlights = false; }}) {
    MethodSettings other = chain;
    change(*other.chain);
    EXPECT_FALSE(is_predictable(other));
    expect_error(ErrorKind::usage, {"target_db", "border"}, [&] { validate(other, target(40)); });
    expect_error(ErrorKind::usage, {"error", "border"}, [&] { validate(other, expects); });
  }
  MethodSettings few = chain, bare = chain;
  few.chain->cells_per_side = 5;
  bare.chain->hidden = Hidden::off;
  for (const MethodSettings& settings : {few, bare}) {
    EXPECT_FALSE(is_predictable(settings));
    validate(settings, target(40));  // which chooses that
    expect_error(ErrorKind::usage, {"error", "hidden"}, [&] { validate(settings, expects); });
  }
  few.chain->cells_per_side = 6;
  EXPECT_TRUE(is_predictable(few));
  validate(chain, target(90));
  validate(literal, {true, false, {}});
}

}  // namespace
}  // namespace defray::test::expected_error_test
