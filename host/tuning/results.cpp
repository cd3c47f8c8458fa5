#include "tuning/results.h"

#include <fmt/format.h>

#include <algorithm>

#include "tuning/shapes.h"

namespace defray::tuning {
namespace {

// Where classes part: between the pictures people render (640x480, 1920x1080, 3840x2160), and where
// rays begin to cross many tiles of the gather (16 px each).
constexpr std::size_t most_small_px = 500'000, most_hd_px = 4'000'000;
constexpr double most_narrow_px = 16;

/// As many times of a try, and pictures of a class, as are kept.
constexpr std::size_t kept_runs = 15, kept_pictures = 4;

// A work-group is used instead of the launch table's when both were run so often, its shortest run
// is so much shorter, and it was faster in three of four pairs. Of 41 alike, medians would choose
// one by chance up to once in four, shortest runs once in fifty (results_test.cpp, Chance).
constexpr std::size_t least_runs = 5;
constexpr double least_gain = 0.03;

std::string size_class(std::size_t pixels) {
  if (pixels <= most_small_px) return "small";
  return pixels <= most_hd_px ? "hd" : "uhd";
}

bool is_same(const Result& a, const Result& b) { return a.place == b.place && a.shape == b.shape; }

/// Keeps the latest pictures of each class: the file is read at every start.
void forget_old_pictures(std::vector<Result>& results) {
  std::map<std::string, std::vector<std::string>> latest;
  for (auto r = results.rbegin(); r != results.rend(); ++r) {
    auto& pictures = latest[r->place.frame_class];
    if (std::find(pictures.begin(), pictures.end(), r->place.picture) == pictures.end()) {
      pictures.push_back(r->place.picture);
    }
  }
  std::erase_if(results, [&](const Result& r) {
    const auto& pictures = latest[r.place.frame_class];
    const auto at = std::find(pictures.begin(), pictures.end(), r.place.picture);
    return at - pictures.begin() >= static_cast<std::ptrdiff_t>(kept_pictures);
  });
}

/// Fills in how far best and own are apart: the latest runs of one by those of the other.
void compare(const Result& own, const Result& best, Finding& f) {
  const std::size_t pairs = std::min(own.run_ms.size(), best.run_ms.size());
  std::vector<double> ratios;
  for (std::size_t i = 1; i <= pairs; ++i) {
    ratios.push_back(best.run_ms[best.run_ms.size() - i] / own.run_ms[own.run_ms.size() - i]);
  }
  std::sort(ratios.begin(), ratios.end());
  f.low = ratios[pairs / 4];
  f.high = ratios[pairs - 1 - pairs / 4];
  const bool is_faster = best.shape != own.shape && f.gain() >= least_gain;
  f.is_adopted = is_faster && pairs >= least_runs && f.high < 1;
  if (is_faster && pairs < least_runs) f.runs_missing = least_runs - pairs;
}

}  // namespace

std::string to_string(const Shape& shape) { return fmt::format("{}x{}", shape.x, shape.y); }

std::string frame_class(std::size_t pixels, double largest_coc_px) {
  return size_class(pixels) + (largest_coc_px <= most_narrow_px ? " narrow" : " wide");
}

std::string cloud_class(std::size_t pixels) { return size_class(pixels) + " cloud"; }

double time_of(const Result& result) {
  return *std::min_element(result.run_ms.begin(), result.run_ms.end());
}

void merge(std::vector<Result>& results, const std::vector<Result>& added) {
  for (const Result& one : added) {
    const auto known = std::find_if(results.begin(), results.end(),
                                    [&](const Result& r) { return is_same(r, one); });
    Result all = one;
    if (known != results.end()) {
      all.run_ms = known->run_ms;
      all.run_ms.insert(all.run_ms.end(), one.run_ms.begin(), one.run_ms.end());
      // Once wrong, never right: a race shows now and then only.
      if (known->validity != Validity::correct) all.validity = known->validity;
      results.erase(known);
    }
    if (all.run_ms.size() > kept_runs) {
      all.run_ms.erase(all.run_ms.begin(),
                       all.run_ms.end() - static_cast<std::ptrdiff_t>(kept_runs));
    }
    results.push_back(std::move(all));
  }
  forget_old_pictures(results);
}

std::vector<const Result*> tries_at(const std::vector<Result>& results, const Place& place) {
  std::vector<const Result*> tries;
  for (const Result& r : results) {
    if (r.place == place && r.validity == Validity::correct && !r.run_ms.empty()) {
      tries.push_back(&r);
    }
  }
  std::stable_sort(tries.begin(), tries.end(),
                   [](auto a, auto b) { return time_of(*a) < time_of(*b); });
  return tries;
}

std::vector<Finding> findings(const std::vector<Result>& results, bool on_gpu) {
  std::vector<Place> places;
  for (auto r = results.rbegin(); r != results.rend(); ++r) {
    const bool is_new = std::find(places.begin(), places.end(), r->place) == places.end();
    if (is_new) places.push_back(r->place);
  }
  std::reverse(places.begin(), places.end());
  std::vector<Finding> all;
  for (const Place& place : places) {
    Finding f{place, own_shape(place.kernel, on_gpu), {}};
    const auto tries = tries_at(results, place);
    const auto own = std::find_if(tries.begin(), tries.end(),
                                  [&](const Result* r) { return r->shape == f.own; });
    if (own == tries.end()) continue;
    const Result& best = *tries.front();
    f.best = best.shape;
    f.own_ms = time_of(**own);
    f.best_ms = time_of(best);
    f.tried = tries.size();
    compare(**own, best, f);
    all.push_back(f);
  }
  return all;
}

std::map<std::string, Shape> adopted(const std::vector<Result>& results,
                                     const std::string& frame_class, bool on_gpu) {
  std::map<std::string, Shape> shapes;
  for (const Finding& f : findings(results, on_gpu)) {
    if (f.place.frame_class != frame_class) continue;
    shapes.erase(f.place.kernel);
    if (f.is_adopted) shapes[f.place.kernel] = f.best;
  }
  return shapes;
}

}  // namespace defray::tuning
