#pragma once
// What defray trade tells: a point of the front each way to render.
#include <optional>
#include <string>
#include <vector>

#include "defray/report.h"
#include "measure/plot.h"

namespace defray::cli {

/// One way to render the picture.
struct TradePoint {
  std::string name;                ///< Of its picture: "draft".
  std::string command;             ///< That makes it.
  double seconds = 0, spread = 0;  ///< Median; (largest - smallest) / median.
  std::optional<ExpectedError> expected;
  std::optional<double> true_db;  ///< Against the truth, where there is one.
  bool is_target = false;         ///< It looks for its quality: no point of the front.

  /// By what points are compared: the true error, or the one that is expected.
  std::optional<double> db() const;
};

struct Trade {
  std::string input, device;
  bool has_truth = false;
  std::vector<TradePoint> points;
  std::size_t recommended = 0;
  std::string why;  ///< It is.
};

/// The fastest that meets the target; without one the fastest within half a dB of the best. One
/// that stands later must be clearly faster.
void recommend(Trade& trade, std::optional<double> target_db);

void print_text(const Trade& trade);
void print_json(const Trade& trade);

/// Error over time: what is expected joined in the order of time, but for what has a target.
Plot plot_of(const Trade& trade);

/// The points' pictures, which lie in `made`, trade.png, index.html and trade.csv.
void write_report(const std::string& folder, const Trade& trade, const std::string& made);

}  // namespace defray::cli
