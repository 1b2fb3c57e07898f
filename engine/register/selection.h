// The cost of a registration, by which one candidate rotation is chosen (paper section 4.4, "Rotation candidate selection").
#pragma once

#include <Eigen/Core>
#include <vector>

#include "engine/data/preprocessed_shape.h"
#include "engine/register/point_location.h"

namespace spherematch {

/// Signals that tell a right registration from a turned one: what only feet, hands and faces show. One row per vertex.
[[nodiscard]] Eigen::MatrixXd selection_signals(const PreprocessedShape& shape);

/// Area-weighted mean over the source's vertices of |signal - signal of the target at the image|, averaged over the columns.
/// `vertex_weights` sum to one.
[[nodiscard]] double registration_cost(const Eigen::MatrixXd& source_signals, const Eigen::VectorXd& vertex_weights,
                                       const Eigen::MatrixXd& target_signals, const Triangles& target_faces,
                                       const std::vector<Location>& locations);

/// The paper's cost: mean absolute difference over the sphere of two signals rasterised at `resolution` and smoothed.
[[nodiscard]] double paper_cost(const Points& source_sphere, const Triangles& source_faces, const Eigen::VectorXd& source_signal,
                                const Points& target_sphere, const Triangles& target_faces, const Eigen::VectorXd& target_signal,
                                int resolution);

}  // namespace spherematch
