#pragma once
// A bounding volume hierarchy: finds the nearest primitive in logarithmic time.
#include <memory>
#include <vector>

#include "scenes/geometry/primitive.h"

namespace defray {

/// A binary tree of boxes over primitives, split at the median of the longest axis. The primitives
/// must outlive it. Any number of threads may trace at once.
class Bvh {
 public:
  explicit Bvh(const std::vector<std::unique_ptr<Primitive>>& primitives);

  /// The nearest hit with ray.from < t < hit.t, if there is one.
  bool intersect(const Ray& ray, Hit& hit) const;

 private:
  /// A leaf has `count` primitives from `first` on; an inner node has its lower child, along
  /// `split`, behind it and its upper one at `first`.
  struct Node {
    Bounds bounds;
    std::size_t first = 0, count = 0;
    double Vec3::*split = nullptr;
  };
  struct Item {
    const Primitive* primitive;
    Bounds bounds;
  };
  void build(std::vector<Item>& items, std::size_t begin, std::size_t end);

  std::vector<Node> nodes_;
  std::vector<const Primitive*> order_;
};

}  // namespace defray
