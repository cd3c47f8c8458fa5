#pragma once
// The points around points, by a k-d tree (nanoflann).
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace defray {

/// The points around each point of a cloud, the nearest first; those at equal distance in the order
/// of their indices.
class Neighbours {
 public:
  /// As many as there are, `most` at most.
  Neighbours(const std::vector<std::array<float, 3>>& places, std::size_t most);

  std::span<const std::uint32_t> of(std::size_t point) const {
    return {all_.data() + point * count_, count_};
  }

  /// Puts others in the places of the last, as coarser ones (add_coarser).
  void put_coarser(std::size_t point, std::span<const std::uint32_t> coarser);

  /// Of those around a point the ones where points lie farther apart, if it lies beside such: the
  /// last, the nearest of them first.
  std::span<const std::uint32_t> coarser(std::size_t point) const {
    return of(point).last(coarser_[point]);
  }

  /// Those that lie as far apart as the point from others.
  std::span<const std::uint32_t> alike(std::size_t point) const {
    return coarser_[point] > 0 ? coarser(point) : of(point);
  }

 private:
  std::size_t count_;
  std::vector<std::uint32_t> all_;
  std::vector<std::uint8_t> coarser_;  ///< How many of a point's are.
};

}  // namespace defray
