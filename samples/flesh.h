// The implicit surface of a creature at rest: round cones along the bones, smoothly blended. Negative inside.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "samples/skeleton.h"

namespace spherematch::samples {

/// The spheres from (a, radius_a) to (b, radius_b), flattened along `thin` (a unit vector) about `a` to `flatness` times their
/// extent. |radius_a - radius_b| is less than the distance of a and b, unless a = b.
struct RoundCone {
  Vec3 a;
  double radius_a;
  Vec3 b;
  double radius_b;
  Vec3 thin{1, 0, 0};
  double flatness = 1;
};

/// A value of an implicit function, and the direction and speed of its growth.
struct Sample {
  double value;
  Vec3 gradient;
};

/// Signed distance; where flattened, value and gradient are those to first order near the surface.
[[nodiscard]] Sample signed_distance(const RoundCone& cone, const Vec3& p);

/// The minimum of a and b, rounded off where they differ by less than `width`; exactly symmetric in a and b.
[[nodiscard]] Sample smooth_minimum(const Sample& a, const Sample& b, double width);

/// A row of an anatomy's table.
struct Part {
  std::string_view bone;  ///< that it belongs to
  double blend;           ///< width of the blend with the parts before it in its group
  RoundCone cone;
  bool carved = false;  ///< taken away instead of added
};

/// Parts that blend with each other, and then as a whole with the groups before. Of a paired group the parts of the left side are
/// given, the right side is their mirror image.
struct Group {
  double blend;
  bool paired;
  std::vector<Part> parts;
};

/// The flesh on a skeleton. Exactly symmetric: sample(p).value == sample(mirrored(p)).value, and the weights at the mirrored point are
/// those of the mirrored bones. Immutable.
class Flesh {
 public:
  /// @throws std::invalid_argument for a part of an unknown bone, and for a bone without a part
  Flesh(Skeleton skeleton, std::vector<Group> groups);

  [[nodiscard]] const Skeleton& skeleton() const { return skeleton_; }
  /// Negative inside, about the distance near the surface.
  [[nodiscard]] Sample sample(const Vec3& p) const;
  /// The surface point below or above p, for p near the surface. A point of the middle plane stays there exactly.
  [[nodiscard]] Vec3 project(Vec3 p) const;

  /// How much each bone takes the skin at p along: non-negative, sum 1, continuous in p. At each joint it is decided by the distances to
  /// the flesh beyond the joint, before it and beyond its sibling joints, over a range of the joint's softness.
  [[nodiscard]] std::vector<double> weights(const Vec3& p) const;
  /// Wanted edge length at p.
  [[nodiscard]] double edge_length(const Vec3& p) const;
  /// A box that the surface lies in.
  [[nodiscard]] std::pair<Vec3, Vec3> bounds() const;

 private:
  /// A group, the ball that its given side is in, and what is needed to skip it from afar.
  struct Limb {
    Group group;
    std::vector<std::size_t> bones;  // of each part
    Vec3 centre;
    double radius = 0;
    double least_flatness = 1;
  };

  [[nodiscard]] std::vector<double> distances(const Vec3& p) const;  // to the flesh of each bone
  [[nodiscard]] static Sample side(const Limb& limb, const Vec3& p, double near);

  Skeleton skeleton_;
  std::vector<Limb> limbs_;
};

}  // namespace spherematch::samples
