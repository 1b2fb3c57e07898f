// The triangle mesh that every stage reads.
#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace spherematch {

/// One point per row, (n, 3), double.
using Points = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;
/// Three vertex indices per row, (m, 3), counter-clockwise seen from outside.
using Triangles = Eigen::Matrix<std::int32_t, Eigen::Dynamic, 3, Eigen::RowMajor>;

struct TriMesh {
  Points vertices;
  Triangles faces;

  [[nodiscard]] Eigen::Index vertex_count() const { return vertices.rows(); }
  [[nodiscard]] Eigen::Index face_count() const { return faces.rows(); }
};

}  // namespace spherematch
