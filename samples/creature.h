// What tells one class of creatures from another: anatomy, poses, holes.
#pragma once

#include <string>
#include <vector>

#include "samples/flesh.h"
#include "samples/landmarks.h"

namespace spherematch::samples {

enum class MeshKind {
  shared,       ///< OFF; the same vertices and triangles in every shared pose
  independent,  ///< OFF; a mesh of its own, with the landmarks among its vertices
  holed,        ///< OFF; the shared mesh with pieces cut out
  glb,          ///< the shared mesh as GLB
};

struct Pose {
  std::string name;
  MeshKind kind;
  std::vector<Turn> turns;
  RigidMotion placement;  ///< after the turns: how the creature lies in its file
};

struct Creature {
  std::string name;
  Flesh flesh;
  std::vector<Ball> holes;   ///< at rest: what the holed pose lacks
  double shared_scale;       ///< of the edge lengths, for the shared mesh
  double independent_scale;  ///< and for the independent one
  std::vector<Pose> poses;
};

/// Four legs, a muzzle, standing ears, a long tail.
[[nodiscard]] Creature hound();
/// Two legs, two arms with three fingers and a thumb, a long nose, large ears, a belly, a tail.
[[nodiscard]] Creature imp();

}  // namespace spherematch::samples
