#pragma once
// How far two pictures are apart. Pictures are linear R G B planes; any more planes are ignored.
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/plane.h"
#include "base/srgb.h"

namespace defray {

/// Errors over a set of pixels, R, G and B taken alike. NaN where a value was NaN.
struct Errors {
  std::size_t pixels = 0;
  double psnr_srgb_db = 0;    ///< Values sRGB-encoded and clipped to 0...1; infinity: equal.
  double psnr_linear_db = 0;  ///< Linear values clipped to 0...1.
  double rms = 0;             ///< Linear, nothing clipped.
};

/// Errors over the whole frame, and what only a whole frame has.
struct Comparison : Errors {
  double worst = 0;  ///< Largest absolute difference of a value, linear; NaN where there is a NaN.
  int worst_x = 0, worst_y = 0;
  std::array<float, 3> worst_a{}, worst_b{};  ///< Both pictures' R G B there.
  /// Mean structural similarity, -1 to 1 (equal): Wang et al. 2004, 11x11 Gaussian window of sigma
  /// 1.5, of sRGB-encoded values clipped to 0...1, mean of R, G and B.
  double ssim = 0;
  double energy_ratio = 0;  ///< Sum of a's values over the sum of b's; infinite: b alone sums to 0.
};

/// Throws Error(usage) when sizes differ or R G B lack.
void require_same_size(const std::vector<Plane>& a, const std::vector<Plane>& b);

/// Compares two pictures of equal size where `mask` is 1; empty: everywhere. (SSIM: of the windows
/// around those pixels.) Throws Error(usage) when sizes differ or R G B lack.
Comparison compare(const std::vector<Plane>& a, const std::vector<Plane>& b, int width,
                   const std::vector<std::uint8_t>& mask = {});

/// Errors over the pixels where `mask` has `value`. PSNR and RMS are NaN where there are none.
Errors errors_where(const std::vector<Plane>& a, const std::vector<Plane>& b,
                    const std::vector<std::uint8_t>& mask, std::uint8_t value);

/// The colour difference image of Glatzel & Wilhelm 2012, fig. 9: white where the pictures are
/// equal, darker by `amplify` times the difference of the sRGB-encoded, clipped values. NaN: black.
std::vector<Plane> difference_picture(const std::vector<Plane>& a, const std::vector<Plane>& b,
                                      double amplify);

}  // namespace defray
