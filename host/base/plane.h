#pragma once
// Planes of pixels in host memory, and whole numbers as indices.
#include <cstddef>
#include <cstdint>
#include <vector>

namespace defray {

/// A plane of floats, row-major, width x height.
using Plane = std::vector<float>;

/// A width, height or count, which is never negative, for indices.
inline std::size_t size(int value) { return static_cast<std::size_t>(value); }

/// The same for kernels' parameters.
inline std::uint32_t word(int value) { return static_cast<std::uint32_t>(value); }

}  // namespace defray
