#pragma once
// Patterns for the built-in scenes, from hashes: the same on every machine.
#include <cstdint>

#include "base/vec3.h"

namespace defray {

/// A number in [0, 1) that looks random, from up to four integers.
double hash01(std::int64_t a, std::int64_t b = 0, std::int64_t c = 0, std::int64_t d = 0);

/// Smooth noise in [0, 1], with features about 1 wide.
double value_noise(double x, double y, std::int64_t seed);

/// A checkerboard with squares of this size, each a little different, with fine grain.
Vec3 checker(double x, double y, double size, const Vec3& even, const Vec3& odd);

/// Bricks in courses, with mortar between them.
Vec3 bricks(double x, double y, double brick_width, double brick_height);

}  // namespace defray
