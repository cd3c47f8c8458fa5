#include "splat/clouds/cloud_columns.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "base/error.h"
#include "base/memory.h"
#include "base/srgb.h"
#include "base/text.h"

namespace defray {
namespace {

/// What a point takes until its cloud is a hierarchy, measured: the most at a time.
constexpr std::uint64_t bytes_a_point = 400;

std::optional<std::size_t> find(const std::vector<std::string>& names, const std::string& wanted) {
  const auto found = std::find(names.begin(), names.end(), wanted);
  if (found == names.end()) return std::nullopt;
  return static_cast<std::size_t>(found - names.begin());
}

/// Of an even number the lower one.
double lower_median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>((values.size() - 1) / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// What lies no farther from 0 than so many times as half of it from its middle stays as it is:
/// that takes four of floats' 24 bits.
constexpr double near_nothing = 16;

/// In the middle of what is finite along an axis: a few that lie far away, or at 0 among places of
/// a geographer's, do not move it.
double middle_of(const std::vector<std::array<double, 3>>& places, std::size_t axis) {
  std::vector<double> along;
  for (const auto& place : places) {
    if (std::isfinite(place[axis])) along.push_back(place[axis]);
  }
  if (along.empty()) return 0;
  const double middle = lower_median(along);
  for (double& place : along) place = std::abs(place - middle);
  return std::abs(middle) <= near_nothing * lower_median(along) ? 0 : middle;
}

/// Places this far from 0, as floats, are in steps of more than this share of how far half of the
/// points are from the middle: of 100 000 points on a body that is a tenth of what they are apart.
constexpr double coarse_step = 1.0 / 2000;

/// What is between floats there, if that is much and all places are floats; else 0.
double step_of(const std::vector<std::array<double, 3>>& places, std::size_t axis, double middle) {
  std::vector<double> from_middle;
  double largest = 0;
  for (const auto& place : places) {
    const double value = place[axis];
    if (!std::isfinite(value)) continue;
    if (static_cast<double>(static_cast<float>(value)) != value) return 0;
    largest = std::max(largest, std::abs(value));
    from_middle.push_back(std::abs(value - middle));
  }
  if (from_middle.empty()) return 0;
  const auto most = static_cast<float>(largest);
  const double step = static_cast<double>(most - std::nextafter(most, 0.0f));
  const double spread = lower_median(from_middle);
  return spread > 0 && step > coarse_step * spread ? step : 0;
}

}  // namespace

void check_memory_for(std::uint64_t points, const std::string& path, const std::string& how_known) {
  const std::uint64_t memory = usable_memory();
  if (points <= memory / bytes_a_point && points < 0xffffffffu) return;
  fail(ErrorKind::input,
       "{}: {} {} points, which need about {:.0f} MiB of memory; there are {}: thin it "
       "out, or split it",
       path, how_known, points, static_cast<double>(points) * bytes_a_point / 1048576,
       memory >> 20);
}

CloudColumns::CloudColumns(const std::vector<std::string>& given_names,
                           const std::vector<double>& whole_numbers, const std::string& path)
    : whole_numbers_(whole_numbers), path_(path) {
  std::vector<std::string> names;
  for (const std::string& name : given_names) names.push_back(lower_case(name));
  const Group place = group(names, {"x", "y", "z"});
  if (!place) {
    fail(ErrorKind::input, "{}: points need x, y and z; it has {}", path, join(names, " "));
  }
  place_ = *place;
  normal_ = group(names, {"nx", "ny", "nz"});
  for (const auto& wanted : {std::array<const char*, 3>{"red", "green", "blue"},
                             {"diffuse_red", "diffuse_green", "diffuse_blue"},
                             {"r", "g", "b"}}) {
    if (!colour_) colour_ = group(names, wanted);
  }
  alpha_ = find(names, "alpha");
  if (!alpha_) alpha_ = find(names, "a");
  radius_ = find(names, "radius");
  note_unused(names);
}

void CloudColumns::note_unused(const std::vector<std::string>& names) {
  std::set<std::size_t> used(place_.begin(), place_.end());
  for (const Group& group : {normal_, colour_}) {
    if (group) used.insert(group->begin(), group->end());
  }
  for (const std::optional<std::size_t>& column : {alpha_, radius_}) {
    if (column) used.insert(*column);
  }
  constexpr std::size_t most = 8;
  std::vector<std::string> unused;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (!used.contains(i)) unused.push_back(unused.size() < most ? names[i] : "...");
  }
  unused.resize(std::min(unused.size(), most + 1));
  if (!unused.empty()) cloud_.notes.push_back("not used: " + join(unused, " "));
}

CloudColumns::Group CloudColumns::group(const std::vector<std::string>& names,
                                        std::array<const char*, 3> wanted) const {
  std::array<std::size_t, 3> columns{};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto column = find(names, wanted[i]);
    if (!column) return std::nullopt;
    columns[i] = *column;
  }
  return columns;
}

void CloudColumns::reserve(std::size_t points) {
  places_.reserve(points);
  if (normal_) cloud_.normals.reserve(points);
  if (colour_) cloud_.colours.reserve(points);
}

double CloudColumns::share(std::span<const double> row, std::size_t column) const {
  const double most = whole_numbers_[column];
  if (most == 0) return row[column];
  if (!(row[column] >= 0 && row[column] <= most)) {
    fail(ErrorKind::input, "{}: point {} has the colour {}: of its type allowed are 0 to {}", path_,
         places_.size() - 1, row[column], most);
  }
  return row[column] / most;
}

float CloudColumns::colour(std::span<const double> row, std::size_t column) const {
  const double value = share(row, column);
  return static_cast<float>(whole_numbers_[column] > 0 ? srgb_decode(value) : value);
}

void CloudColumns::add(std::span<const double> row) {
  places_.push_back({row[place_[0]], row[place_[1]], row[place_[2]]});
  const auto floats = [&](const std::array<std::size_t, 3>& columns) {
    return std::array<float, 3>{static_cast<float>(row[columns[0]]),
                                static_cast<float>(row[columns[1]]),
                                static_cast<float>(row[columns[2]])};
  };
  if (normal_) cloud_.normals.push_back(floats(*normal_));
  if (radius_) cloud_.radii.push_back(static_cast<float>(row[*radius_]));
  if (colour_) {
    cloud_.colours.push_back(
        {colour(row, (*colour_)[0]), colour(row, (*colour_)[1]), colour(row, (*colour_)[2])});
  }
  if (alpha_) cloud_.alpha.push_back(static_cast<float>(share(row, *alpha_)));
}

PointCloud CloudColumns::take() && {
  double step = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    cloud_.origin[k] = middle_of(places_, k);
    step = std::max(step, step_of(places_, k, cloud_.origin[k]));
  }
  if (step > 0) {
    cloud_.notes.push_back(fmt::format(
        "places are in steps of {:g} units: floats have no more digits so far from 0: export "
        "doubles, or places less an offset",
        step));
  }
  cloud_.positions.reserve(places_.size());
  for (const auto& place : places_) {
    cloud_.positions.push_back({static_cast<float>(place[0] - cloud_.origin[0]),
                                static_cast<float>(place[1] - cloud_.origin[1]),
                                static_cast<float>(place[2] - cloud_.origin[2])});
  }
  return std::move(cloud_);
}

}  // namespace defray
