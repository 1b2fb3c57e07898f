// Hints: pairs of vertices that the caller knows to correspond, roughly. They add a candidate rotation, pull the spheres together
// before the flow, and count in the selection.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "engine/data/parameters.h"
#include "engine/data/surface.h"
#include "engine/data/tri_mesh.h"
#include "engine/register/flow_side.h"

namespace spherematch {

/// A point of a mesh as a mean of its vertices: weights are non-negative with sum 1.
struct VertexMean {
  std::array<std::int32_t, 3> vertices{};
  Eigen::Vector3d weights;

  [[nodiscard]] Eigen::Vector3d of(const Points& points) const {
    return weights[0] * points.row(vertices[0]) + weights[1] * points.row(vertices[1]) + weights[2] * points.row(vertices[2]);
  }
};

struct PlacedHint {
  VertexMean source;
  VertexMean target;
};

/// Unit vectors, one row per hint: where hints lie on the two prepared spheres.
struct HintDirections {
  Points source;
  Points target;
};

/// @throws EngineError(invalid_parameter) where a hint is outside of an upload or on a dropped vertex
[[nodiscard]] std::vector<PlacedHint> place_hints(const Surface& source, const Surface& target, const std::vector<Hint>& hints);

/// The rotation that brings the hints of the source sphere nearest to those of the target sphere, in a sum of angles that single
/// wrong hints hardly move: Kabsch's solution, reweighted. Nothing where the hints do not determine a rotation, being less than two
/// or near one axis.
[[nodiscard]] std::optional<Eigen::Matrix3d> rotation_from_hints(const HintDirections& hints);

[[nodiscard]] HintDirections directions(const std::vector<PlacedHint>& hints, const Points& source_sphere, const Points& target_sphere);

/// Moves both sides half way, by a smooth deformation that brings the hints nearer to each other and reaches about `width` radians
/// around them. Hints that are far apart, as wrong ones among right ones are, pull less; beyond a right angle not at all.
void pull_together(FlowSide& source, FlowSide& target, const HintDirections& hints, double width);

}  // namespace spherematch
