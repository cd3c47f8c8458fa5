#pragma once
// Poisson-disk points in the unit disc: the samples of a gather.
#include <array>
#include <cstdint>
#include <vector>

namespace defray {

/// Points in the unit disc that keep their distance, in an order of which every beginning is a good
/// set too.
struct PoissonDisk {
  std::vector<std::array<double, 2>> points;
  /// No two of the first n points are closer than spacing[n - 1]. Falls as n grows; from three
  /// points on it is at least 0.6 times that of n points on a hexagonal grid over the disc.
  std::vector<double> spacing;
};

inline constexpr int poisson_disk_max_count = 1024;

/// `count` points for this seed. They come as antipodal pairs, an odd count begins with the centre:
/// the mean of a set is 0, so a filter with it moves nothing. Throws Error(usage) unless
/// 1 <= count <= poisson_disk_max_count.
///
/// Dart throwing with a shrinking disc (McCool & Fiume, "Hierarchical Poisson disk sampling
/// distributions", 1992), two antipodal darts at a time.
PoissonDisk make_poisson_disk(int count, std::uint32_t seed);

}  // namespace defray
