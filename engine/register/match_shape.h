// What registration reads of one shape, in the form in which it reads it: made once and used by any number of matches.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "engine/data/preprocessed_shape.h"
#include "engine/data/tri_mesh.h"
#include "engine/register/point_location.h"
#include "engine/sphere/flip_repair.h"
#include "engine/sphere/grid_samples.h"

namespace spherematch {

/// A shape as it was prepared, or its mirror image. Immutable, thread-safe.
class MatchShape {
 public:
  /// Keeps the shape. Takes some 50 ms for 50,000 vertices. @throws EngineError(invalid_parameter) when the shape has no signals
  explicit MatchShape(std::shared_ptr<const PreprocessedShape> shape, bool mirrored = false);
  MatchShape(const MatchShape&) = delete;
  MatchShape& operator=(const MatchShape&) = delete;

  [[nodiscard]] const PreprocessedShape& shape() const { return *shape_; }
  [[nodiscard]] const Surface& surface() const { return shape_->surface; }
  [[nodiscard]] bool mirrored() const { return mirrored_; }
  [[nodiscard]] std::unique_ptr<const MatchShape> mirror_image() const { return std::make_unique<const MatchShape>(shape_, !mirrored_); }

  /// The vertices of surface().mesh on the prepared sphere, (V, 3), mirrored where the shape is.
  [[nodiscard]] const Points& sphere() const { return sphere_; }
  /// The faces of surface().mesh, (F, 3), oriented like sphere().
  [[nodiscard]] const Triangles& faces() const { return faces_; }
  /// In these faces.
  [[nodiscard]] const PointLocation& location() const { return location_; }
  [[nodiscard]] const FlipRepair& repair() const { return repair_; }

  /// The stored signals on the prepared sphere.
  [[nodiscard]] const GridSamples& signals() const { return signals_; }
  /// The channel of a stored signal. @throws EngineError(invalid_parameter) when no signal has the name
  [[nodiscard]] Eigen::Index channel(const std::string& name) const;
  /// The channels of the stored eigenfunctions, by rising frequency and without the constant.
  [[nodiscard]] std::vector<Eigen::Index> eigenfunctions() const;
  /// A stored signal. @throws as channel()
  [[nodiscard]] Grid signal(const std::string& name) const;

  /// The prepared sphere as it was stored, of the surface's working mesh, mirrored where the shape is; and the faces of that mesh.
  [[nodiscard]] Points working_sphere() const;
  [[nodiscard]] Triangles working_faces() const;

  /// Bytes of what this adds to the shape.
  [[nodiscard]] std::size_t index_bytes() const;

 private:
  std::shared_ptr<const PreprocessedShape> shape_;
  bool mirrored_;
  GridSamples signals_;
  Points sphere_;
  Triangles faces_;
  FlipRepair repair_;
  PointLocation location_;
};

}  // namespace spherematch
