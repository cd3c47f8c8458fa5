#include "prediction/expected_error.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/parallel.h"
#include "lens/lens_grid.h"

namespace defray {
namespace {

std::size_t light_channels(const Frame& f) {
  return std::min<std::size_t>(3, f.channels.size() - (f.has_alpha ? 1 : 0));
}

/// Rows of blocks that are looked at together: what they take of memory does not grow with frames.
constexpr int strip_height = 256;

Making making_of(const ChainSettings& settings, int lens_points) {
  return {lens_points, settings.hidden == Hidden::patterns, settings.half_size};
}

double sum(const Squares& squares) { return std::accumulate(squares.begin(), squares.end(), 0.0); }

/// `to_add` and what lies between two blocks, so far from the first, times `weight`.
Squares added(Squares to_add, const std::array<float, cause_count>& first,
              const std::array<float, cause_count>& second, double share, double weight) {
  for (std::size_t c = 0; c < cause_count; ++c) {
    to_add[c] += weight * (double{first[c]} + (double{second[c]} - double{first[c]}) * share);
  }
  return to_add;
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
                       const MethodResult& result, bool wants_planes)
    : width_(frame.width),
      height_(frame.height),
      across_((frame.width + block_px - 1) / block_px),
      making_(making_of(settings, result.report->lens_points)) {
  const int rows = block_rows(frame);
  for (int y = 0; y < rows; y += strip_height) {
    add_rows(frame, result, {y, std::min(rows, y + strip_height)}, wants_planes);
  }
  for (double& mean : means_) mean /= static_cast<double>(across_) * rows;
  const Squares means = squares_of(means_, weights_of(making_));
  const double all = sum(means);
  factor_ = frame_factor(all);
  of_frame_ = expected_from(all * factor_);
  for (std::size_t c = 0; c < cause_count; ++c) {
    of_frame_.shares[c] = all > 0 ? means[c] / all : 0;
  }
}

void Prediction::add_rows(const Frame& frame, const MethodResult& result, Rows rows,
                          bool wants_planes) {
  const Rows around{std::max(0, rows.y - sign_reach),
                    std::min(block_rows(frame), rows.end + sign_reach)};
  const std::vector<SignValues> signs =
      signs_of(blocks_of(frame, result.colour, result.confidence, around), light_channels(frame),
               {rows.y - around.y, rows.end - around.y});
  const auto weights = weights_of(making_);
  for (const SignValues& of_block : signs) {
    for (std::size_t i = 0; i < sign_count; ++i) means_[i] += double{of_block[i]};
    if (!wants_planes) continue;
    const Squares squares = squares_of(of_block, weights);
    auto& kept = squares_.emplace_back();
    for (std::size_t c = 0; c < cause_count; ++c) kept[c] = static_cast<float>(squares[c]);
  }
}

double Prediction::guess_db(const ChainSettings& other) const {
  const Making making = making_of(other, round_cells(other.cells_per_side));
  const double all = sum(squares_of(means_, weights_of(making)));
  return expected_from(all * frame_factor(all)).psnr_db;
}

std::vector<Plane> Prediction::planes() const {
  std::vector<Plane> out(1 + cause_count, Plane(size(width_) * size(height_)));
  parallel_for(height_, [&](int y) {
    const Between row(y, (height_ + block_px - 1) / block_px);
    const auto* const above = &squares_[size(row.first) * size(across_)];
    const auto* const below = &squares_[size(row.second) * size(across_)];
    for (int x = 0; x < width_; ++x) {
      const Between column(x, across_);
      const std::size_t left = size(column.first), right = size(column.second);
      Squares squares = added({}, above[left], above[right], column.share, 1 - row.share);
      squares = added(squares, below[left], below[right], column.share, row.share);
      const std::size_t i = size(y) * size(width_) + size(x);
      for (std::size_t c = 0; c < cause_count; ++c) {
        out[c + 1][i] = static_cast<float>(std::sqrt(squares[c] * factor_));
      }
      out[0][i] = static_cast<float>(std::sqrt(sum(squares) * factor_));
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
  const auto weights = weights_of(making_), all = weights_of({1, false, true});
  std::array<double, sign_count> means = means_;
  for (std::size_t i = 0; i < sign_count; ++i) means[i] *= weights[i] / all[i];
  return means;
}

}  // namespace defray
