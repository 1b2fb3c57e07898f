// Linear finite elements on a triangulation: cotangent stiffness and consistent mass.
#pragma once

#include <Eigen/SparseCore>
#include <algorithm>
#include <array>
#include <initializer_list>
#include <vector>

#include "engine/data/tri_mesh.h"
#include "engine/mesh/intrinsic_delaunay.h"

namespace spherematch {

using SparseMatrix = Eigen::SparseMatrix<double>;

/// The area of each face, (F).
[[nodiscard]] Eigen::VectorXd face_areas(const Points& vertices, const Triangles& faces);

/// A third of the area of the faces around each vertex, (V).
[[nodiscard]] Eigen::VectorXd vertex_areas(const Points& vertices, const Triangles& faces);

/// The six distinct entries of a symmetric 3x3 element matrix: the diagonal at the face's corners 0, 1, 2, then the entries of
/// its edges (1,2), (2,0), (0,1).
using ElementMatrix = std::array<double, 6>;

/// Sums element matrices of one triangulation into sparse matrices of a given pattern, so that a solver analyses it once.
/// Immutable; refers to nothing after construction.
class ElementAssembler {
 public:
  /// `pattern` holds every edge of `faces` (see edge_pattern).
  ElementAssembler(const SparseMatrix& pattern, const Triangles& faces);

  /// Overwrites `matrix`, which has the pattern, with the sum of `element(face)` over all faces, in face order.
  template <typename Element>
  void assemble(SparseMatrix& matrix, const Element& element) const {
    double* values = matrix.valuePtr();
    std::fill(values, values + matrix.nonZeros(), 0.0);
    for (std::size_t f = 0; f < slots_.size(); ++f) {
      const ElementMatrix e = element(static_cast<Eigen::Index>(f));
      for (std::size_t k = 0; k < 6; ++k) values[slots_[f][k]] += e[k];
    }
  }

 private:
  std::vector<std::array<int, 6>> slots_;  ///< per face, where its entries stand in the value array
};

/// A (V, V) lower-triangular matrix of zeros with an entry for each vertex and each edge of the triangulations.
[[nodiscard]] SparseMatrix edge_pattern(std::initializer_list<const Triangles*> triangulations, Eigen::Index vertex_count);

/// Element of the cotangent stiffness matrix (positive semidefinite, rows sum to zero) of a triangle with the given edge lengths
/// opposite its corners and the given positive area.
[[nodiscard]] ElementMatrix stiffness_element(const Eigen::Vector3d& lengths, double area);

/// Element of the consistent mass matrix: area/6 on the diagonal, area/12 beside it.
[[nodiscard]] ElementMatrix mass_element(double area);

/// Lower triangles of the stiffness and consistent mass matrices, (V, V) each.
struct Laplacian {
  SparseMatrix stiffness;
  SparseMatrix mass;
};
[[nodiscard]] Laplacian cotangent_laplacian(const IntrinsicMesh& mesh, Eigen::Index vertex_count);

}  // namespace spherematch
