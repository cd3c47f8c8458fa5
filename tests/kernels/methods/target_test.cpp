// What a target of accuracy makes of a picture, and of a sequence's.
#include <algorithm>
#include <cmath>
#include <set>

#include "kernels/methods/expected_error_support.h"

namespace defray::test::expected_error_test {
namespace {

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
  ErrorSettings wanted = target(at({Quality::normal, 9}) - 0.001);
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
