// What defray trade recommends and draws of the points it has measured.
#include "trade/trade_report.h"

#include <gtest/gtest.h>

namespace defray::test::trade_report_test {
namespace {

using cli::Trade;
using cli::TradePoint;

TradePoint point(const std::string& name, double seconds, double expected_db,
                 std::optional<double> true_db = {}) {
  TradePoint p{name, "", seconds, 0, ExpectedError{}, true_db};
  p.expected->psnr_db = expected_db;
  return p;
}

TEST(Trade, RecommendsTheFastestThatWillDo) {
  Trade trade{"in.exr", "device", false, {}, 0, ""};
  trade.points = {point("preview", 1, 30), point("draft", 2, 39.6), point("normal", 4, 40),
                  point("slow", 3, 39.9)};
  const auto recommended = [&](std::optional<double> target_db) {
    recommend(trade, target_db);
    return trade.points[trade.recommended].name;
  };
  EXPECT_EQ(recommended({}), "draft");
  EXPECT_EQ(recommended(20), "preview");
  EXPECT_EQ(trade.why, "the fastest that meets 20 dB");
  EXPECT_EQ(recommended(39.7), "slow");
  EXPECT_EQ(recommended(40), "normal");
  EXPECT_EQ(recommended(41), "draft");
  EXPECT_EQ(trade.why, "the fastest within 0.5 dB of the best; none meets 41 dB");
  // What is known counts, not what is expected.
  trade.points[0].true_db = 45;
  EXPECT_EQ(recommended({}), "preview");
  trade.points[0].expected.reset();
  EXPECT_EQ(recommended({}), "preview");
  trade.points[1] = {"unknown", "", 0.5, 0, {}, {}};
  EXPECT_EQ(recommended(1), "preview");
}

TEST(Trade, PlotsTheFrontInTheOrderOfTimeAndATargetAlone) {
  Trade trade{"in.exr", "device", false, {}, 0, ""};
  trade.points = {point("preview", 1, 30), point("high", 4, 41), point("normal", 3, 40, 39),
                  point("target", 2, 30)};
  trade.points[3].is_target = true;
  const Plot plot = cli::plot_of(trade);
  ASSERT_EQ(plot.series.size(), 3u);
  std::string joined;
  for (const PlotPoint& p : plot.series[0].points) joined += p.label + " ";
  EXPECT_TRUE(plot.series[0].lines);
  EXPECT_EQ(joined, "preview normal high ");
  EXPECT_EQ(plot.series[1].points.size(), 1u);
  EXPECT_FALSE(plot.series[2].lines);
  EXPECT_EQ(plot.series[2].points[0].label, "target");
}

}  // namespace
}  // namespace defray::test::trade_report_test
