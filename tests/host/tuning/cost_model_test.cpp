// Times that are learnt, and what fits a budget.
#include "tuning/cost_model.h"

#include <fstream>

#include "image/safe_output.h"
#include "lens/lens_grid.h"
#include "support.h"

namespace defray::test::cost_model_test {
namespace {

using tuning::Cost;
using tuning::CostModel;
using tuning::Key;

const std::string hd = "hd narrow";

std::size_t index_of(const Rung& rung) {
  return static_cast<std::size_t>(std::find(rungs().begin(), rungs().end(), rung) -
                                  rungs().begin());
}

double points(int cells) { return static_cast<double>(make_lens_grid(cells, false).points.size()); }

/// Every quality costs this, and a tenth of a millisecond a lens point.
CostModel flat_model(double fixed_s = 0.1) {
  CostModel model;
  for (const Quality quality : all_qualities) model.take(hd, quality, {fixed_s, 1e-4});
  return model;
}

TEST(Rungs, GoFromPreviewToHighThroughEveryQuality) {
  EXPECT_EQ(rungs().front(), (Rung{Quality::preview, 6}));
  EXPECT_EQ(rungs().back(), (Rung{Quality::high, 33}));
  for (const Quality quality : all_qualities) {
    EXPECT_LT(index_of({quality, settings_for(quality).cells_per_side}), rungs().size());
  }
  for (std::size_t i = 1; i < rungs().size(); ++i) {
    const Rung &a = rungs()[i - 1], &b = rungs()[i];
    EXPECT_TRUE(a.quality < b.quality ||
                (a.quality == b.quality && b.cells_per_side == a.cells_per_side + 1));
  }
}

TEST(CostModel, IsFixedAndByLensPointAndByPixels) {
  const CostModel model = flat_model();
  EXPECT_NEAR(model.seconds(hd, {Quality::normal, 13}, 1), 0.1 + 137e-4, 1e-12);
  EXPECT_NEAR(model.seconds(hd, {Quality::normal, 13}, 2.5), 2.5 * (0.1 + 137e-4), 1e-12);
  EXPECT_NEAR(model.seconds(hd, {Quality::draft, 9}, 1), 0.1 + points(9) * 1e-4, 1e-12);
}

TEST(CostModel, TakesTheBestThatFits) {
  const CostModel model = flat_model();
  const auto chosen = [&](double budget_s) {
    return rungs()[model.choose(hd, 1, budget_s, std::nullopt)];
  };
  EXPECT_EQ(chosen(0.05), (Rung{Quality::preview, 6}));  // too little for any
  EXPECT_EQ(chosen(0.1 + points(20) * 1e-4 + 1e-9), (Rung{Quality::normal, 20}));
  EXPECT_EQ(chosen(0.1 + points(20) * 1e-4 - 1e-9), (Rung{Quality::normal, 19}));
  EXPECT_EQ(chosen(10), (Rung{Quality::high, 33}));
}

TEST(CostModel, RisesSlowlyAndFallsAtOnce) {
  const CostModel model = flat_model();
  const std::size_t low = index_of({Quality::normal, 10}), high = index_of({Quality::normal, 20});
  EXPECT_EQ(model.choose(hd, 1, 10, low), low + 2);
  EXPECT_EQ(model.choose(hd, 1, 10, rungs().size() - 2), rungs().size() - 1);
  const double of_11 = 0.1 + points(11) * 1e-4, of_10 = 0.1 + points(10) * 1e-4;
  EXPECT_EQ(model.choose(hd, 1, 1.001 * of_10, high), low);
  CostModel steep;
  for (const Quality quality : all_qualities) steep.take(hd, quality, {0.01, 1e-3});
  const double steep_11 = 0.01 + points(11) * 1e-3;
  EXPECT_EQ(steep.choose(hd, 1, 1.001 * steep_11, low), low + 1);
  EXPECT_LT(of_10, of_11);
}

TEST(CostModel, StaysWhereItIsNearTheBudget) {
  CostModel model;
  for (const Quality quality : all_qualities) model.take(hd, quality, {0.25, 1e-5});
  const std::size_t here = index_of({Quality::normal, 13});
  const double now = model.seconds(hd, rungs()[here], 1);
  EXPECT_EQ(model.choose(hd, 1, now / 0.96, here), here);
  EXPECT_EQ(model.choose(hd, 1, now / 0.94, here), here + 2);
}

TEST(CostModel, LearnsHalfTheWayWithinLimits) {
  const auto learnt = [](double times, bool is_first) {
    CostModel model = flat_model();
    const Rung rung{Quality::normal, 13};
    model.refine(hd, rung, 2, 2 * 0.1 * times, 2 * 137e-4 * times, is_first);
    const Cost cost = model.costs().at({hd, Quality::normal});
    EXPECT_NEAR(cost.point_s / 1e-4, cost.fixed_s / 0.1, 1e-9);
    return cost.fixed_s / 0.1;
  };
  EXPECT_NEAR(learnt(1, false), 1, 1e-12);
  EXPECT_NEAR(learnt(2, false), 1.5, 1e-12);
  EXPECT_NEAR(learnt(0.5, false), 0.75, 1e-12);
  EXPECT_NEAR(learnt(50, false), 2, 1e-12);   // at most three times
  EXPECT_NEAR(learnt(50, true), 1.5, 1e-12);  // kernels were compiled
  EXPECT_NEAR(learnt(0.01, true), 2.0 / 3, 1e-12);
}

TEST(CostModel, WhatIsUnknownFollowsTheDevicesSpeed) {
  CostModel model;
  const CostModel empty;
  const Rung draft{Quality::draft, 9}, other{Quality::high, 33};
  // Three times as slow as built in, in either part.
  const double rays = 3 * points(9) * 8e-4;
  const double fixed = 3 * empty.seconds(hd, draft, 1) - rays;
  for (int i = 0; i < 30; ++i) model.refine(hd, draft, 1, fixed, rays, false);
  EXPECT_NEAR(model.seconds(hd, draft, 1), 3 * empty.seconds(hd, draft, 1), 1e-6);
  EXPECT_NEAR(model.seconds("uhd wide", other, 1), 3 * empty.seconds("uhd wide", other, 1), 1e-3);
  // The class itself counts before others.
  model.take("uhd wide", Quality::preview, {0.07, 3e-4});
  EXPECT_NEAR(model.seconds("uhd wide", other, 1), empty.seconds("uhd wide", other, 1), 1e-9);
}

TEST(CostModel, TakesNothingBeyondTheBudgetWhileSomethingFits) {
  CostModel model;
  const Rung normal{Quality::normal, 9};
  const double seconds = model.seconds(hd, normal, 1);
  const auto chosen = [&] { return rungs()[model.choose(hd, 1, 0.9 * seconds, std::nullopt)]; };
  EXPECT_EQ(chosen().quality, Quality::draft);
  // A quality that was never measured, beside others that were, is expected to take what it takes.
  model.take(hd, Quality::preview, {0.07, 3e-4});
  model.take(hd, Quality::draft, {0.12, 8e-4});
  EXPECT_EQ(chosen().quality, Quality::draft);
  model.take(hd, Quality::normal, {0.28, 8e-4});
  EXPECT_EQ(chosen().quality, Quality::draft);
  // Nor does one that is two rungs higher than the last, where a higher one fits.
  model.take(hd, Quality::draft, {2, 0.05});
  model.take(hd, Quality::normal, {0.01, 1e-5});
  std::size_t last = 0;
  while (rungs()[last + 1].quality == Quality::preview) ++last;
  EXPECT_EQ(model.choose(hd, 1, 0.2, last), last);
}

TEST(CostModel, WhatIsWrongHeals) {
  CostModel model = flat_model();
  model.take(hd, Quality::normal, {10, 1e-2});
  model.take("uhd wide", Quality::normal, {10, 1e-2});
  for (int i = 0; i < 600; ++i) {
    model.refine(hd, {Quality::draft, 9}, 1, 0.12, points(9) * 8e-4, false);
  }
  const Cost healed = model.costs().at({hd, Quality::normal});
  EXPECT_NEAR(healed.fixed_s, 0.28, 0.01);
  EXPECT_NEAR(healed.point_s, 8e-4, 1e-5);
  EXPECT_NEAR(model.costs().at({hd, Quality::draft}).fixed_s, 0.12, 1e-9);
  EXPECT_EQ(model.costs().at({"uhd wide", Quality::normal}).fixed_s, 10);
}

class CostFile : public testing::Test {
 protected:
  Folder folder;
  const std::string path = folder / "cache/cost.json";
  const Key key{"a device", "a platform", "driver 1", "00ff"};

  std::string notice_of(const std::string& text) const {
    write_text(path, text);
    std::string notice;
    EXPECT_TRUE(tuning::read_costs(path, key, notice).costs().empty()) << text;
    return notice;
  }
};

TEST_F(CostFile, KeepsTheModel) {
  std::string notice;
  EXPECT_TRUE(tuning::read_costs(path, key, notice).costs().empty());
  EXPECT_EQ(notice, "");
  CostModel model;
  model.take(hd, Quality::draft, {0.125, 0.0005});
  model.take("uhd wide", Quality::high, {0.25, 0.00025});
  tuning::write_costs(path, key, model);
  const CostModel read = tuning::read_costs(path, key, notice);
  EXPECT_EQ(notice, "");
  ASSERT_EQ(read.costs().size(), 2u);
  EXPECT_EQ(read.costs().at({hd, Quality::draft}).fixed_s, 0.125);
  EXPECT_EQ(read.costs().at({"uhd wide", Quality::high}).point_s, 0.00025);
}

TEST_F(CostFile, OfOthersOrDamagedOrWildIsNotUsed) {
  CostModel model;
  model.take(hd, Quality::draft, {0.125, 0.0005});
  tuning::write_costs(path, key, model);
  std::ifstream file(path);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string changed = text;
    EXPECT_NE(changed.find(from), std::string::npos);
    return notice_of(changed.replace(changed.find(from), from.size(), to));
  };
  const auto says = [](const std::string& notice, const std::string& words) {
    EXPECT_NE(notice.find(words), std::string::npos) << notice;
    EXPECT_NE(notice.find("times are learnt anew"), std::string::npos) << notice;
  };
  says(with("driver 1", "driver 2"), "is of another driver");
  says(with("00ff", "00fe"), "is of another version of the kernels");
  says(with("draft", "daft"), "quality 'daft'");
  says(with("0.125", "1e9"), "costs of 1000000000 s");
  says(with("0.125", "1e-9"), "costs of 1e-09 s");
  says(with("0.0005", "-1"), "and -1 s");
  says(with("0.0005", "\"\""), "is damaged");
  says(notice_of(text.substr(0, text.size() / 2)), "is damaged");
  EXPECT_EQ(notice_of("{}").find(path), 0u);
}

}  // namespace
}  // namespace defray::test::cost_model_test
