#include "prediction/expected_error.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/parallel.h"
#include "chain/ray_plan.h"

namespace defray {
namespace {

std::size_t light_channels(const Frame& f) {
  return std::min<std::size_t>(3, f.channels.size() - (f.has_alpha ? 1 : 0));
}

using Squares = std::array<double, cause_count>;

Making making_of(const ChainSettings& settings, int lens_points) {
  return {lens_points, settings.hidden == Hidden::patterns, settings.half_size};
}

Squares mean_squares(const std::vector<SignValues>& signs) {
  Squares means{};
  for (const SignValues& of_block : signs) {
    const Squares squares = squares_of(of_block);
    for (std::size_t c = 0; c < cause_count; ++c) means[c] += squares[c];
  }
  for (double& mean : means) mean /= static_cast<double>(signs.size());
  return means;
}

double sum(const Squares& squares) { return std::accumulate(squares.begin(), squares.end(), 0.0); }

Squares mix(Squares a, const Squares& b, double share) {
  for (std::size_t c = 0; c < cause_count; ++c) a[c] += (b[c] - a[c]) * share;
  return a;
}

/// The blocks between whose middles a pixel's middle lies, along one axis.
struct Between {
  Between(int pixel, int blocks) {
    const double at = (pixel + 0.5) / block_px - 0.5;
    first = std::max(0, static_cast<int>(std::floor(at)));
    second = std::min(first + 1, blocks - 1);
    share = std::clamp(at - first, 0.0, 1.0);
  }
  int first, second;
  double share;
};

}  // namespace

Prediction::Prediction(const Frame& frame, const ChainSettings& settings,
                       const MethodResult& result)
    : width_(frame.width),
      height_(frame.height),
      blocks_(blocks_of(frame, result.colour, result.confidence)),
      channels_(light_channels(frame)),
      signs_(signs_of(blocks_, channels_, making_of(settings, result.report->lens_points))) {
  const Squares means = mean_squares(signs_);
  const double all = sum(means);
  factor_ = frame_factor(all);
  of_frame_ = expected_from(all * factor_);
  for (std::size_t c = 0; c < cause_count; ++c) {
    of_frame_.shares[c] = all > 0 ? means[c] / all : 0;
  }
}

double Prediction::guess_db(const ChainSettings& other) const {
  const int lens_points = static_cast<int>(ray_plan(other, false).lens.points.size());
  const double all = sum(mean_squares(signs_of(blocks_, channels_, making_of(other, lens_points))));
  return expected_from(all * frame_factor(all)).psnr_db;
}

std::vector<Plane> Prediction::planes() const {
  std::vector<Plane> out(1 + cause_count, Plane(size(width_) * size(height_)));
  parallel_for(height_, [&](int y) {
    const Between row(y, blocks_.down);
    for (int x = 0; x < width_; ++x) {
      const Between column(x, blocks_.across);
      const auto value_at = [&](int j, int i) {
        return squares_of(signs_[size(j) * size(blocks_.across) + size(i)]);
      };
      const Squares above =
          mix(value_at(row.first, column.first), value_at(row.first, column.second), column.share);
      const Squares below = mix(value_at(row.second, column.first),
                                value_at(row.second, column.second), column.share);
      const Squares squares = mix(above, below, row.share);
      const std::size_t i = size(y) * size(width_) + size(x);
      double all = 0;
      for (std::size_t c = 0; c < cause_count; ++c) {
        out[c + 1][i] = static_cast<float>(std::sqrt(squares[c] * factor_));
        all += squares[c];
      }
      out[0][i] = static_cast<float>(std::sqrt(all * factor_));
    }
  });
  return out;
}

std::vector<std::string> Prediction::plane_names() {
  std::vector<std::string> names{"total"};
  for (std::size_t c = 0; c < cause_count; ++c) names.emplace_back(to_string(Cause(c)));
  return names;
}

std::array<double, sign_count> Prediction::mean_signs() const {
  std::array<double, sign_count> means{};
  for (const SignValues& signs : signs_) {
    for (std::size_t i = 0; i < sign_count; ++i) means[i] += double{signs[i]};
  }
  for (double& mean : means) mean /= static_cast<double>(signs_.size());
  return means;
}

}  // namespace defray
