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

 private:
  std::size_t count_;
  std::vector<std::uint32_t> all_;
};

}  // namespace defray
