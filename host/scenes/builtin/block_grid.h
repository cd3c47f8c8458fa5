#pragma once
// A block world as one primitive: rays walk from block to block.
#include "scenes/builtin/block_world.h"
#include "scenes/geometry/primitive.h"

namespace defray {

/// Where the camera stands in a block world, and where it looks. Metres; world axes: x, y up, z.
struct Viewpoint {
  Vec3 position;
  Vec3 right, down, forward;  ///< Unit length, at right angles.

  /// Looks along +z turned to the right by `yaw`, then down by `pitch` (radians).
  static Viewpoint looking(const Vec3& position, double yaw, double pitch);

  /// A direction of the world in the camera's axes.
  Vec3 to_camera(const Vec3& direction) const;
};

/// The blocks, textured with 16 x 16 texels a face, lit. A ray hits a block where it comes out of
/// the air; what stands behind it in one piece is not hit.
class BlockGrid : public Primitive {
 public:
  /// The world must outlive the grid.
  BlockGrid(const BlockWorld& world, const Viewpoint& view) : world_(world), view_(view) {}
  bool intersect(const Ray& ray, Hit& hit) const override;
  Bounds bounds() const override;

 private:
  Vec3 to_world(const Vec3& direction) const;
  const BlockWorld& world_;
  Viewpoint view_;
};

}  // namespace defray
