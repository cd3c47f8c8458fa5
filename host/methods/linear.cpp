#include "methods/linear.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "base/error.h"
#include "kernels/params.h"

namespace defray {
namespace {

std::size_t as_size(int i) { return static_cast<std::size_t>(i); }

float radius_px(std::int32_t coc_quanta) {
  return static_cast<float>(std::abs(coc_quanta)) * px_per_quantum;
}

/// Sums of the soft disc clamp(r + 1/2 - d, 0, 1) over all pixels, for any radius up to a largest:
/// from the number of pixels at each squared distance, and the sum of their distances.
class DiscNorms {
 public:
  explicit DiscNorms(int reach)
      : count_(as_size(squared(reach + 1)) + 1), distance_(count_.size()) {
    for (int y = -reach; y <= reach; ++y) {
      for (int x = -reach; x <= reach; ++x) {
        const std::size_t d2 = as_size(x * x + y * y);
        if (d2 < count_.size()) ++count_[d2];
      }
    }
    for (std::size_t d2 = 1; d2 < count_.size(); ++d2) {
      distance_[d2] = distance_[d2 - 1] + count_[d2] * std::sqrt(static_cast<double>(d2));
      count_[d2] += count_[d2 - 1];
    }
  }

  double operator()(double radius) const {
    const double outer = radius + 0.5, inner = std::max(radius - 0.5, 0.0);
    const std::size_t o = within(outer);
    if (radius < 0.5) return count_[o] * outer - distance_[o];
    const std::size_t i = within(inner);
    return count_[i] + (count_[o] - count_[i]) * outer - (distance_[o] - distance_[i]);
  }

 private:
  static int squared(int i) { return i * i; }
  static std::size_t within(double distance) {
    return static_cast<std::size_t>(std::floor(distance * distance));
  }
  std::vector<double> count_, distance_;  // up to this squared distance
};

/// One band's source planes with the frame's edge pixels repeated around them.
class PaddedBand {
 public:
  PaddedBand(int width, int height, int band_y, int band_rows, int reach)
      : width_(width), height_(height), first_(band_y - reach), reach_(reach) {
    stride = stride_for(width, reach);
    rows = as_size(band_rows + 2 * reach);
  }

  /// Floats in a row: reach on both sides, and whole runs from the first target pixel on.
  static std::size_t stride_for(int width, int reach) {
    return target_stride_for(width) + 2 * as_size(reach);
  }
  static std::size_t target_stride_for(int width) {
    constexpr std::size_t run = DEFRAY_LINEAR_RUN;
    return (as_size(width) + run - 1) / run * run;
  }

  /// `value(i)` is the plane's value at frame index i.
  template <typename Value>
  Plane plane(const Value& value) const {
    Plane out(rows * stride);
    for (std::size_t row = 0; row < rows; ++row) {
      const int y = std::clamp(first_ + static_cast<int>(row), 0, height_ - 1);
      const std::size_t line = as_size(y) * as_size(width_);
      for (std::size_t column = 0; column < stride; ++column) {
        const int x = std::clamp(static_cast<int>(column) - reach_, 0, width_ - 1);
        out[row * stride + column] = value(line + as_size(x));
      }
    }
    return out;
  }

  std::size_t stride, rows;

 private:
  int width_, height_, first_, reach_;
};

constexpr std::size_t planes_in = 5, planes_out = 4;

/// Rows of a band whose planes fit the memory.
int band_rows_for(int width, int height, int reach, std::size_t memory_bytes) {
  const std::size_t least = linear_band_bytes(width, reach, 1);
  if (memory_bytes < least) {
    fail(ErrorKind::usage,
         "{} is {:.3g} MiB: one row of {} pixels with CoC radii up to {} px needs {} MiB",
         field("memory"), std::ldexp(static_cast<double>(memory_bytes), -20), width, reach,
         (least >> 20) + 1);
  }
  const std::size_t row = linear_band_bytes(width, reach, 2) - least;
  return static_cast<int>(std::min(as_size(height), 1 + (memory_bytes - least) / row));
}

/// Whole pixels that a disc of this radius reaches; it ends half a pixel beyond its radius.
int reach_of(std::int32_t coc_quanta) {
  constexpr std::int32_t half = 1 << (DEFRAY_COC_FRACTION_BITS - 1);
  return (std::abs(coc_quanta) + half) >> DEFRAY_COC_FRACTION_BITS;
}

/// Reach of each row of a padded band.
std::vector<std::int32_t> row_reaches(const Plane& radius, const PaddedBand& band) {
  std::vector<std::int32_t> reaches;
  for (std::size_t row = 0; row < band.rows; ++row) {
    const auto begin = radius.begin() + static_cast<std::int64_t>(row * band.stride);
    const float largest = *std::max_element(begin, begin + static_cast<std::int64_t>(band.stride));
    reaches.push_back(static_cast<std::int32_t>(largest + 0.5f));
  }
  return reaches;
}

/// Rows of a launch: few enough that a progress bar moves.
constexpr std::uint32_t rows_per_launch = 16;

void blur_band(Session& session, DefrayLinearParams p, const PaddedBand& band, int band_rows,
               const Plane& radius, const std::vector<Plane>& scaled, std::vector<Plane>& out,
               const std::function<void(int rows)>& progress) {
  const auto rows = static_cast<std::uint32_t>(band_rows);
  const std::size_t bytes = std::size_t{p.target_stride} * rows * sizeof(float);
  const std::vector<std::int32_t> reaches = row_reaches(radius, band);
  const cl::Buffer reach = session.view(reaches), r = session.view(radius);
  cl::Buffer in[4], result[4];
  // The kernel always sums four channels; a missing one repeats the last and is not read back.
  for (std::size_t c = 0; c < 4; ++c) {
    in[c] = c < scaled.size() ? session.picture(scaled[c].data(), scaled[c].size()) : in[c - 1];
    result[c] = session.buffer(bytes);
  }
  for (p.first_row = 0; p.first_row < rows; p.first_row += rows_per_launch) {
    p.launch_rows = std::min(rows_per_launch, rows - p.first_row);
    session.launch("linear_psf", DEFRAY_LINEAR_GROUP,
                   {p.target_stride / DEFRAY_LINEAR_RUN, p.launch_rows}, p, reach, r, in[0], in[1],
                   in[2], in[3], result[0], result[1], result[2], result[3]);
    session.finish();
    progress(static_cast<int>(p.first_row + p.launch_rows));
  }
  for (std::size_t c = 0; c < out.size(); ++c) {
    out[c].resize(bytes / sizeof(float));
    session.read(result[c], out[c].data(), bytes);
  }
}

}  // namespace

std::size_t linear_band_bytes(int width, int reach, int rows) {
  const std::size_t in_row = planes_in * sizeof(float) * PaddedBand::stride_for(width, reach);
  const std::size_t out_row = planes_out * sizeof(float) * PaddedBand::target_stride_for(width);
  return as_size(rows + 2 * reach) * in_row + as_size(rows) * out_row;
}

int linear_reach(const std::vector<std::int32_t>& coc_quanta) {
  const std::int32_t largest = largest_coc(coc_quanta);
  if (largest > linear_max_radius_px << DEFRAY_COC_FRACTION_BITS) {
    fail(ErrorKind::usage,
         "CoC radii go up to {:.6g} px: linear filtering takes {} px at most; limit them with {}, "
         "or use {} rdb",
         static_cast<double>(radius_px(largest)), linear_max_radius_px, field("max_coc_px"),
         field("method"));
  }
  return reach_of(largest);
}

std::vector<Plane> render_linear(Session& session, int width, int height,
                                 const std::vector<std::int32_t>& coc_quanta,
                                 const std::vector<Plane>& channels, const LinearSettings& settings,
                                 const std::function<void(double)>& progress) {
  const int reach = linear_reach(coc_quanta);
  const DiscNorms norm(reach + 1);
  std::vector<Plane> out(channels.size(), Plane(coc_quanta.size())), band_out(channels.size());
  const std::size_t budget = std::min(settings.memory_bytes, session.info().max_buffer_bytes);
  const int rows = band_rows_for(width, height, reach, budget);
  for (int y = 0; y < height; y += rows) {
    const int band_rows = std::min(rows, height - y);
    const PaddedBand band(width, height, y, band_rows, reach);
    const Plane radius = band.plane([&](std::size_t i) { return radius_px(coc_quanta[i]); });
    std::vector<Plane> scaled;
    for (const Plane& channel : channels) {
      scaled.push_back(band.plane([&](std::size_t i) {
        const double twice = 2 * norm(static_cast<double>(radius_px(coc_quanta[i])));
        return channel[i] / static_cast<float>(twice);
      }));
    }
    DefrayLinearParams p{};
    p.width = static_cast<std::uint32_t>(width);
    p.source_stride = static_cast<std::uint32_t>(band.stride);
    p.target_stride = static_cast<std::uint32_t>(PaddedBand::target_stride_for(width));
    p.reach = reach;
    blur_band(session, p, band, band_rows, radius, scaled, band_out, [&](int done) {
      if (progress) progress(static_cast<double>(y + done) / height);
    });
    for (std::size_t c = 0; c < out.size(); ++c) {
      for (int row = 0; row < band_rows; ++row) {
        std::copy_n(band_out[c].begin() + std::int64_t{row} * p.target_stride, width,
                    out[c].begin() + std::int64_t{y + row} * width);
      }
    }
  }
  return out;
}

}  // namespace defray
