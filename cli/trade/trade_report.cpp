#include "trade/trade_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <system_error>

#include "base/error.h"
#include "image/safe_output.h"
#include "measure/html_report.h"

namespace defray::cli {
namespace {

constexpr double nearly_best_db = 0.5;
constexpr double clearly_faster = 0.8;  ///< Times that are closer change places from run to run.

/// "40.2", or what stands where nothing is known.
std::string decibels(const std::optional<double>& db) {
  if (!db) return "-";
  return *db == HUGE_VAL ? "equal" : fmt::format("{:.1f}", *db);
}

std::string range(const std::optional<ExpectedError>& e) {
  return e ? fmt::format("{:.1f} ({:.1f} to {:.1f})", e->psnr_db, e->low_db, e->high_db) : "-";
}

Table table_of(const Trade& trade) {
  Table table{"trade",
              "Decibels are PSNR of sRGB-encoded values. Expected ones are told from how the "
              "pictures look, and hold between the two others in nine of ten scenes.",
              {"picture", "time", "expected dB", "true dB", "command"},
              {},
              {"picture", "recommended", "seconds", "spread", "expected_db", "low_db", "high_db",
               "true_db", "command"},
              {}};
  const auto figure = [](const std::optional<double>& v) { return v ? fmt::format("{}", *v) : ""; };
  for (std::size_t i = 0; i < trade.points.size(); ++i) {
    const TradePoint& p = trade.points[i];
    table.rows.push_back({p.name + (i == trade.recommended ? " (recommended)" : ""),
                          fmt::format("{:.3f} s ± {:.0f} %", p.seconds, 100 * p.spread),
                          range(p.expected), decibels(p.true_db), p.command});
    std::vector<std::string> cells{p.name, i == trade.recommended ? "yes" : "no", figure(p.seconds),
                                   figure(p.spread)};
    for (double ExpectedError::*const value :
         {&ExpectedError::psnr_db, &ExpectedError::low_db, &ExpectedError::high_db}) {
      cells.push_back(p.expected ? figure((*p.expected).*value) : "");
    }
    cells.push_back(figure(p.true_db));
    cells.push_back(p.command);
    table.csv_rows.push_back(std::move(cells));
  }
  return table;
}

void copy_picture(const std::string& from, const std::string& to) {
  write_safely(to, [&](const std::string& name) {
    std::error_code error;
    std::filesystem::copy_file(from, name, std::filesystem::copy_options::overwrite_existing,
                               error);
    if (error) fail(ErrorKind::output, "{}: cannot be written: {}", to, error.message());
  });
}

}  // namespace

std::optional<double> TradePoint::db() const {
  if (true_db || !expected) return true_db;
  return expected->psnr_db;
}

Plot plot_of(const Trade& trade) {
  Plot plot{"Error against time", "seconds", "PSNR, sRGB, dB", true, false, {}};
  Series expected{"expected, without a truth", {}, true, true}, truly{"true", {}, false, true},
      target{"expected, with a target", {}, false, true};
  for (const TradePoint& p : trade.points) {
    Series& series = p.is_target ? target : expected;
    if (p.expected) series.points.push_back({p.seconds, p.expected->psnr_db, p.name});
    if (p.true_db && std::isfinite(*p.true_db))
      truly.points.push_back({p.seconds, *p.true_db, p.name});
  }
  std::stable_sort(expected.points.begin(), expected.points.end(),
                   [](const PlotPoint& a, const PlotPoint& b) { return a.x < b.x; });
  for (Series* series : {&expected, &truly, &target}) {
    if (!series->points.empty()) plot.series.push_back(std::move(*series));
  }
  return plot;
}

void recommend(Trade& trade, std::optional<double> target_db) {
  const auto db_of = [](const TradePoint& p) {
    const double db = p.db().value_or(0);
    return std::isnan(db) ? 0 : std::min(db, 200.0);  // equal pictures are no better than that
  };
  double best = 0;
  for (const TradePoint& p : trade.points) best = std::max(best, db_of(p));
  const bool is_reached = target_db && best >= *target_db;
  const double least = is_reached ? *target_db : best - nearly_best_db;
  trade.why = is_reached ? fmt::format("the fastest that meets {:.4g} dB", *target_db)
                         : fmt::format("the fastest within {} dB of the best", nearly_best_db);
  if (target_db && !is_reached) trade.why += fmt::format("; none meets {:.4g} dB", *target_db);
  double fastest = HUGE_VAL;
  for (std::size_t i = 0; i < trade.points.size(); ++i) {
    if (db_of(trade.points[i]) < least) continue;
    if (trade.points[i].seconds >= clearly_faster * fastest) continue;
    fastest = trade.points[i].seconds;
    trade.recommended = i;
  }
}

void print_text(const Trade& trade) {
  fmt::print("{} on {}\n", trade.input, trade.device);
  fmt::print("  {:<18} {:>9} {:>24} {:>8}\n", "picture", "s", "expected dB",
             trade.has_truth ? "true dB" : "");
  for (const TradePoint& p : trade.points) {
    fmt::print("  {:<18} {:>9.3f} {:>24} {:>8}\n", p.name, p.seconds, range(p.expected),
               trade.has_truth ? decibels(p.true_db) : "");
  }
  fmt::print("  recommended, {}:\n    {}\n", trade.why, trade.points[trade.recommended].command);
}

void print_json(const Trade& trade) {
  nlohmann::ordered_json points = nlohmann::ordered_json::array();
  for (const TradePoint& p : trade.points) {
    nlohmann::ordered_json point = {
        {"picture", p.name}, {"render_s", p.seconds}, {"spread", p.spread}, {"command", p.command}};
    if (p.expected) {
      point["expected_db"] = p.expected->psnr_db;
      point["low_db"] = p.expected->low_db;
      point["high_db"] = p.expected->high_db;
    }
    if (p.true_db) point["true_db"] = *p.true_db;
    points.push_back(point);
  }
  const nlohmann::ordered_json json = {{"input", trade.input},
                                       {"device", trade.device},
                                       {"points", points},
                                       {"recommended", trade.points[trade.recommended].name},
                                       {"why", trade.why}};
  fmt::print("{}\n", json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
}

void write_report(const std::string& folder, const Trade& trade, const std::string& made) {
  for (const TradePoint& p : trade.points) {
    copy_picture(made + "/" + p.name + ".png", folder + "/" + p.name + ".png");
  }
  write_plot(folder + "/trade.png", plot_of(trade));
  Section section{"Error against time", "", {}, {table_of(trade)}, {}};
  section.findings.push_back("Recommended, " + trade.why + ": " +
                             trade.points[trade.recommended].name + ".");
  section.figures.push_back({"trade.png", "Up and to the left is better."});
  for (const TradePoint& p : trade.points) section.figures.push_back({p.name + ".png", p.name});
  write_page(folder, {"defray trade: " + trade.input, "On " + trade.device + ".", {section}});
}

}  // namespace defray::cli
