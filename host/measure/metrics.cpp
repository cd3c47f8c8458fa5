#include "measure/metrics.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core/ocl.hpp>
#include <opencv2/quality/qualityssim.hpp>
#include <span>

#include "base/error.h"
#include "base/parallel.h"
#include "image/ldr.h"

namespace defray {
namespace {

constexpr std::size_t rgb = 3;

double clipped(float value) { return std::clamp(static_cast<double>(value), 0.0, 1.0); }

/// Of two infinities of one sign, 0; NaN where a value is NaN.
double difference(float a, float b) {
  return a == b ? 0 : static_cast<double>(a) - static_cast<double>(b);
}

/// Peak signal is 1.
double psnr_db(double squared_error_sum, double count) {
  return 10 * std::log10(count / squared_error_sum);
}

/// Sums of squares of differences, and of how many pixels.
struct SquareSums {
  double encoded = 0, linear = 0, raw = 0;
  std::size_t pixels = 0;

  void operator+=(const SquareSums& other) {
    encoded += other.encoded;
    linear += other.linear;
    raw += other.raw;
    pixels += other.pixels;
  }

  void add(float a, float b) {
    const double shown = shown_value(a) - shown_value(b), light = clipped(a) - clipped(b);
    const double any = difference(a, b);
    encoded += shown * shown;
    linear += light * light;
    raw += any * any;
    ++pixels;
  }
};

/// Errors over the pixels that `is_counted` accepts.
template <typename IsCounted>
Errors errors_over(const std::vector<Plane>& a, const std::vector<Plane>& b,
                   const IsCounted& is_counted) {
  SquareSums all;
  for (std::size_t c = 0; c < rgb; ++c) {
    all += parallel_sum(a[c].size(), [&](std::size_t first, std::size_t end) {
      SquareSums sums;
      for (std::size_t i = first; i < end; ++i) {
        if (is_counted(i)) sums.add(a[c][i], b[c][i]);
      }
      return sums;
    });
  }
  const auto count = static_cast<double>(all.pixels);
  Errors errors;
  errors.pixels = all.pixels / rgb;
  errors.psnr_srgb_db = psnr_db(all.encoded, count);
  errors.psnr_linear_db = psnr_db(all.linear, count);
  errors.rms = std::sqrt(all.raw / count);
  return errors;
}

template <typename IsCounted>
void find_worst(const std::vector<Plane>& a, const std::vector<Plane>& b, int width,
                const IsCounted& is_counted, Comparison& result) {
  std::size_t at = 0;
  for (std::size_t c = 0; c < rgb && !std::isnan(result.worst); ++c) {
    for (std::size_t i = 0; i < a[c].size() && !std::isnan(result.worst); ++i) {
      const double error = std::fabs(difference(a[c][i], b[c][i]));
      if (error <= result.worst || !is_counted(i)) continue;  // a NaN is worse than anything
      result.worst = error;
      at = i;
    }
  }
  result.worst_x = static_cast<int>(at % static_cast<std::size_t>(width));
  result.worst_y = static_cast<int>(at / static_cast<std::size_t>(width));
  for (std::size_t c = 0; c < rgb; ++c) {
    result.worst_a[c] = a[c][at];
    result.worst_b[c] = b[c][at];
  }
}

cv::Mat encoded_bytes(const Plane& plane, int width) {
  cv::Mat image(static_cast<int>(plane.size()) / width, width, CV_32F);
  const std::span<float> to(image.ptr<float>(), plane.size());
  parallel_for_each(plane.size(), [&](std::size_t i) {
    to[i] = static_cast<float>(255 * shown_value(plane[i]));
  });
  return image;
}

/// Where a mask is, which may be empty.
double mean_ssim(const std::vector<Plane>& a, const std::vector<Plane>& b, int width,
                 const std::vector<std::uint8_t>& mask) {
  cv::ocl::setUseOpenCL(false);  // one result, whatever devices there are
  double sum = 0;
  for (std::size_t c = 0; c < rgb; ++c) {
    cv::Mat map;
    const double all = cv::quality::QualitySSIM::compute(encoded_bytes(a[c], width),
                                                         encoded_bytes(b[c], width), map)[0];
    sum += mask.empty() ? all : cv::mean(map, cv::Mat(mask, false).reshape(1, map.rows))[0];
  }
  return sum / rgb;
}

template <typename IsCounted>
double energy(const std::vector<Plane>& picture, const IsCounted& is_counted) {
  double sum = 0;
  for (std::size_t c = 0; c < rgb; ++c) {
    sum += parallel_sum(picture[c].size(), [&](std::size_t first, std::size_t end) {
      double part = 0;
      for (std::size_t i = first; i < end; ++i) {
        if (is_counted(i)) part += static_cast<double>(picture[c][i]);
      }
      return part;
    });
  }
  return sum;
}

}  // namespace

void require_same_size(const std::vector<Plane>& a, const std::vector<Plane>& b) {
  if (a.size() < rgb || b.size() < rgb || a[0].size() != b[0].size()) {
    fail(ErrorKind::usage, "pictures to compare differ in size: {} and {} pixels",
         a.empty() ? 0 : a[0].size(), b.empty() ? 0 : b[0].size());
  }
}

Comparison compare(const std::vector<Plane>& a, const std::vector<Plane>& b, int width,
                   const std::vector<std::uint8_t>& mask) {
  require_same_size(a, b);
  const auto is_counted = [&](std::size_t i) { return mask.empty() || mask[i] == 1; };
  Comparison result{errors_over(a, b, is_counted)};
  find_worst(a, b, width, is_counted, result);
  result.ssim = mean_ssim(a, b, width, mask);
  const double of_a = energy(a, is_counted), of_b = energy(b, is_counted);
  result.energy_ratio = of_a == of_b ? 1 : of_a / of_b;  // of two black pictures, too
  return result;
}

Errors errors_where(const std::vector<Plane>& a, const std::vector<Plane>& b,
                    const std::vector<std::uint8_t>& mask, std::uint8_t value) {
  require_same_size(a, b);
  return errors_over(a, b, [&](std::size_t i) { return mask[i] == value; });
}

std::vector<Plane> difference_picture(const std::vector<Plane>& a, const std::vector<Plane>& b,
                                      double amplify) {
  require_same_size(a, b);
  std::vector<Plane> picture(rgb, Plane(a[0].size()));
  for (std::size_t c = 0; c < rgb; ++c) {
    parallel_for_each(a[c].size(), [&](std::size_t i) {
      const double shown = 1 - amplify * std::fabs(shown_value(a[c][i]) - shown_value(b[c][i]));
      picture[c][i] = shown > 0 ? static_cast<float>(srgb_decode(shown)) : 0;
    });
  }
  return picture;
}

}  // namespace defray
