#pragma once
// Pictures for OpenCV, for its own sources alone.
#include <opencv2/core.hpp>
#include <vector>

#include "base/plane.h"

namespace defray {

/// Linear R G B, sRGB-encoded in 8 bits, as OpenCV orders them.
cv::Mat to_mat(const std::vector<Plane>& planes, int width, int height);

}  // namespace defray
