#include "tuning/cost_model.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "image/safe_output.h"
#include "lens/lens_grid.h"
#include "tuning/device_file.h"

namespace defray::tuning {
namespace {

/// On two cores of an AMD EPYC at 1280x720, CoC up to 23 px (`render --stats` of scene spheres).
Cost built_in_cost(Quality quality) {
  switch (quality) {
    case Quality::preview:
      return {0.07, 0.0003};
    case Quality::draft:
      return {0.12, 0.0008};
    case Quality::normal:
      return {0.28, 0.0008};
    case Quality::high:
      break;
  }
  return {0.33, 0.0008};
}

// Of what was expected, a budget is kept to a tenth: below that rungs do not change.
constexpr double near_enough = 0.95;
constexpr std::size_t most_rise = 2;
constexpr double share_of_new = 0.5, share_of_healing = 0.02;
/// Times are believed up to so many times what was expected, or down to that part: something else
/// may have run meanwhile. The first picture of a quality waits for kernels that are compiled or
/// loaded.
constexpr double most_surprise = 3, most_at_first = 2;
/// Costs beyond so many times the built-in ones are no computer's.
constexpr double most_ratio = 100;

double towards(double from, double to, double share) { return from + share * (to - from); }

}  // namespace

Cost CostModel::cost(const std::string& frame_class, Quality quality) const {
  const auto found = costs_.find({frame_class, quality});
  if (found != costs_.end()) return found->second;
  // The device's speed: of the class, else of any.
  std::vector<double> ratios, of_class;
  for (const auto& [what, known] : costs_) {
    const Cost built_in = built_in_cost(what.second);
    ratios.push_back(
        std::sqrt(known.fixed_s / built_in.fixed_s * known.point_s / built_in.point_s));
    if (what.first == frame_class) of_class.push_back(ratios.back());
  }
  auto& near = of_class.empty() ? ratios : of_class;
  std::sort(near.begin(), near.end());
  const double ratio = near.empty() ? 1 : near[near.size() / 2];
  const Cost built_in = built_in_cost(quality);
  return {ratio * built_in.fixed_s, ratio * built_in.point_s};
}

double CostModel::seconds(const std::string& frame_class, const Rung& rung,
                          double megapixels) const {
  const Cost c = cost(frame_class, rung.quality);
  return megapixels * (c.fixed_s + round_cells(rung.cells_per_side) * c.point_s);
}

std::size_t CostModel::choose(const std::string& frame_class, double megapixels, double budget_s,
                              std::optional<std::size_t> last) const {
  const std::size_t highest =
      last ? std::min(*last + most_rise, rungs().size() - 1) : rungs().size() - 1;
  std::size_t best = 0;
  for (std::size_t i = 0; i <= highest; ++i) {
    if (seconds(frame_class, rungs()[i], megapixels) <= budget_s) best = i;
  }
  if (!last || best <= *last) return best;
  const double of_last = seconds(frame_class, rungs()[*last], megapixels);
  return of_last >= near_enough * budget_s && of_last <= budget_s ? *last : best;
}

void CostModel::refine(const std::string& frame_class, const Rung& rung, double megapixels,
                       double fixed_s, double rays_s, bool is_first) {
  const double most = is_first ? most_at_first : most_surprise;
  const Cost expected = cost(frame_class, rung.quality);
  const auto learnt = [most](double was, double is) {
    return towards(was, std::clamp(is, was / most_surprise, was * most), share_of_new);
  };
  const Cost learnt_cost{
      learnt(expected.fixed_s, fixed_s / megapixels),
      learnt(expected.point_s, rays_s / megapixels / round_cells(rung.cells_per_side))};
  costs_[{frame_class, rung.quality}] = learnt_cost;
  const Cost own = built_in_cost(rung.quality);
  for (auto& [what, other] : costs_) {
    if (what.first != frame_class || what.second == rung.quality) continue;
    const Cost built_in = built_in_cost(what.second);
    other.fixed_s = towards(other.fixed_s, learnt_cost.fixed_s / own.fixed_s * built_in.fixed_s,
                            share_of_healing);
    other.point_s = towards(other.point_s, learnt_cost.point_s / own.point_s * built_in.point_s,
                            share_of_healing);
  }
}

void CostModel::take(const std::string& frame_class, Quality quality, const Cost& cost) {
  const Cost built_in = built_in_cost(quality);
  for (const double ratio : {cost.fixed_s / built_in.fixed_s, cost.point_s / built_in.point_s}) {
    if (ratio > 1 / most_ratio && ratio < most_ratio) continue;
    fail(ErrorKind::internal, "costs of {} s and {} s", cost.fixed_s, cost.point_s);
  }
  costs_[{frame_class, quality}] = cost;
}

CostModel read_costs(const std::string& path, const Key& key, std::string& notice) {
  CostModel model;
  notice = read_device_file(path, key, "times are learnt anew", [&](const Json& json) {
    for (const Json& one : json.at("costs")) {
      const auto name = one.at("quality").get<std::string>();
      const auto quality = std::find_if(all_qualities.begin(), all_qualities.end(),
                                        [&](Quality q) { return to_string(q) == name; });
      if (quality == all_qualities.end()) fail(ErrorKind::internal, "quality '{}'", name);
      model.take(one.at("frame_class"), *quality, {one.at("fixed_s"), one.at("point_s")});
    }
  });
  return notice.empty() ? model : CostModel();
}

void write_costs(const std::string& path, const Key& key, const CostModel& model) {
  Json costs = Json::array();
  for (const auto& [what, cost] : model.costs()) {
    costs.push_back({{"frame_class", what.first},
                     {"quality", to_string(what.second)},
                     {"fixed_s", cost.fixed_s},
                     {"point_s", cost.point_s}});
  }
  const DeviceFileLock lock(path);
  write_text(path, Json{{"metadata", to_json(key)}, {"costs", costs}}.dump() + "\n");
}

}  // namespace defray::tuning
