#include "splat/surfels/neighbours.h"

#include <algorithm>
#include <nanoflann.hpp>
#include <utility>

#include "base/parallel.h"

namespace defray {
namespace {

/// Places as nanoflann asks for them.
struct Places {
  const std::vector<std::array<float, 3>>& all;

  std::size_t kdtree_get_point_count() const { return all.size(); }
  float kdtree_get_pt(std::uint32_t point, std::size_t axis) const { return all[point][axis]; }
  template <typename Box>
  bool kdtree_get_bbox(Box& /*box*/) const {
    return false;  // it finds one itself
  }
};

using Index = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, Places>,
                                                  Places, 3, std::uint32_t>;

/// The nearest `count` to a point, itself left out.
void find_nearest(const Index& index, const Places& places, std::uint32_t point,
                  std::span<std::uint32_t> out) {
  std::vector<std::uint32_t> indices(out.size() + 1);
  std::vector<float> squares(out.size() + 1);
  index.knnSearch(places.all[point].data(), indices.size(), indices.data(), squares.data());
  std::vector<std::pair<float, std::uint32_t>> nearest;
  for (std::size_t i = 0; i < indices.size(); ++i) {
    if (indices[i] != point) nearest.emplace_back(squares[i], indices[i]);
  }
  std::sort(nearest.begin(), nearest.end());
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = nearest[i].second;
}

}  // namespace

Neighbours::Neighbours(const std::vector<std::array<float, 3>>& places, std::size_t most)
    : count_(std::min(most, places.size() - 1)),
      all_(count_ * places.size()),
      coarser_(places.size()) {
  const Places points{places};
  const Index index(3, points);
  parallel_for_each(places.size(), [&](std::size_t i) {
    find_nearest(index, points, static_cast<std::uint32_t>(i), {all_.data() + i * count_, count_});
  });
}

void Neighbours::put_coarser(std::size_t point, std::span<const std::uint32_t> coarser) {
  coarser_[point] = static_cast<std::uint8_t>(coarser.size());
  const auto end = all_.begin() + static_cast<std::ptrdiff_t>((point + 1) * count_);
  std::copy(coarser.begin(), coarser.end(), end - std::ssize(coarser));
}

}  // namespace defray
