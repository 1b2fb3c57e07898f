// The bones of a creature in its rest pose, and how a pose turns them.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "samples/rotation.h"

namespace spherematch::samples {

struct Bone {
  std::string name;
  int parent;       ///< -1 for the root; parents come before their children
  int mirror;       ///< the bone of the other side, itself in the middle
  Vec3 pivot;       ///< the joint that it turns about, in the rest pose
  double softness;  ///< of the joint: over what distance the skin changes from one side to the other
  double edge;      ///< wanted edge length of its mesh
};

/// A row of an anatomy's table. A bone whose pivot is left of the middle (x > 0) stands for two: NAME.l and, mirrored, NAME.r.
struct BoneRow {
  std::string_view name, parent;  ///< parent "" for the root, without .l
  Vec3 pivot;
  double softness, edge;
};

/// One turn of a joint about an axis given in the rest pose; a joint's turns apply in their order, before those of its parents.
struct Turn {
  std::string_view bone;
  Vec3 axis;
  double degrees;
};

class Skeleton {
 public:
  explicit Skeleton(std::span<const BoneRow> rows);

  [[nodiscard]] const std::vector<Bone>& bones() const { return bones_; }
  /// NAME, or NAME.l where there are two.
  /// @throws std::invalid_argument when there is no such bone
  [[nodiscard]] int find(std::string_view name) const;
  /// For each bone the motion from the rest pose to the posed one.
  [[nodiscard]] std::vector<RigidMotion> motions(std::span<const Turn> turns) const;

 private:
  std::vector<Bone> bones_;
};

}  // namespace spherematch::samples
