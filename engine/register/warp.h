// A diffeomorphism of the sphere: a rotation, then steps along tangent fields.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "engine/data/tri_mesh.h"
#include "engine/sphere/advection.h"

namespace spherematch {

/// How a prepared sphere is carried to where it is registered. Fields are shared with the warp of the other shape.
class Warp {
 public:
  explicit Warp(const Eigen::Matrix3d& rotation) : rotation_(rotation) {}

  [[nodiscard]] const Eigen::Matrix3d& rotation() const { return rotation_; }

  void append(std::shared_ptr<const TangentField> field, double step) { steps_.push_back({std::move(field), step}); }

  /// Images of the unit vectors `points` (P, 3), on up to `threads` threads.
  [[nodiscard]] Points forward(const Points& points, int threads = 1) const;
  /// Preimages: each step is undone by one in the opposite direction, up to the third order of the step.
  [[nodiscard]] Points backward(const Points& points, int threads = 1) const;

 private:
  struct Step {
    std::shared_ptr<const TangentField> field;
    double length;
  };

  Eigen::Matrix3d rotation_;
  std::vector<Step> steps_;
};

}  // namespace spherematch
