#pragma once
// Errors without the truth's own noise.
#include <vector>

#include "scenes/subject.h"

namespace defray::perf {

/// Two pictures of one scene through the lens whose noise has nothing in common: the mean product
/// of a render's differences to them is its squared error, without theirs. May be the same twice.
struct TwoTruths {
  std::vector<Plane> first, second;
};

TwoTruths make_two_truths(const Subject& subject, int rays);

/// Mean over R, G and B of the products of a picture's differences to two truths, a pixel each, of
/// sRGB values.
Plane square_errors(const std::vector<Plane>& picture, const TwoTruths& truths);

double mean_of(const Plane& plane);

/// dB, at most 90, as noise may leave nothing or less.
double psnr_of(double square_error);

}  // namespace defray::perf
