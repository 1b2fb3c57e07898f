#include "engine/mesh/laplacian.h"

#include <Eigen/Geometry>

namespace spherematch {
namespace {

constexpr int kEdges[3][2] = {{1, 2}, {2, 0}, {0, 1}};

}  // namespace

Eigen::VectorXd face_areas(const Points& vertices, const Triangles& faces) {
  Eigen::VectorXd areas(faces.rows());
  for (Eigen::Index f = 0; f < faces.rows(); ++f) {
    const Eigen::Vector3d a = vertices.row(faces(f, 0)), b = vertices.row(faces(f, 1)), c = vertices.row(faces(f, 2));
    areas[f] = 0.5 * (b - a).cross(c - a).norm();
  }
  return areas;
}

Eigen::VectorXd vertex_areas(const Points& vertices, const Triangles& faces) {
  const Eigen::VectorXd areas = face_areas(vertices, faces);
  Eigen::VectorXd result = Eigen::VectorXd::Zero(vertices.rows());
  for (Eigen::Index f = 0; f < faces.rows(); ++f)
    for (int k = 0; k < 3; ++k) result[faces(f, k)] += areas[f] / 3;
  return result;
}

SparseMatrix edge_pattern(std::initializer_list<const Triangles*> triangulations, Eigen::Index vertex_count) {
  std::vector<Eigen::Triplet<double>> entries;
  for (Eigen::Index v = 0; v < vertex_count; ++v) entries.emplace_back(v, v, 0.0);
  for (const Triangles* faces : triangulations)
    for (Eigen::Index f = 0; f < faces->rows(); ++f)
      for (const auto& e : kEdges) {
        const std::int32_t i = (*faces)(f, e[0]), j = (*faces)(f, e[1]);
        entries.emplace_back(std::max(i, j), std::min(i, j), 0.0);
      }
  SparseMatrix pattern(vertex_count, vertex_count);
  pattern.setFromTriplets(entries.begin(), entries.end());
  pattern.makeCompressed();
  return pattern;
}

ElementAssembler::ElementAssembler(const SparseMatrix& pattern, const Triangles& faces) : slots_(static_cast<std::size_t>(faces.rows())) {
  const auto slot = [&pattern](int i, int j) {
    const int row = std::max(i, j), column = std::min(i, j);
    const int* begin = pattern.innerIndexPtr() + pattern.outerIndexPtr()[column];
    const int* end = pattern.innerIndexPtr() + pattern.outerIndexPtr()[column + 1];
    return static_cast<int>(std::lower_bound(begin, end, row) - pattern.innerIndexPtr());
  };
  for (Eigen::Index f = 0; f < faces.rows(); ++f) {
    auto& slots = slots_[static_cast<std::size_t>(f)];
    for (int k = 0; k < 3; ++k) {
      slots[static_cast<std::size_t>(k)] = slot(faces(f, k), faces(f, k));
      slots[static_cast<std::size_t>(k) + 3] = slot(faces(f, kEdges[k][0]), faces(f, kEdges[k][1]));
    }
  }
}

ElementMatrix stiffness_element(const Eigen::Vector3d& lengths, double area) {
  const double a = lengths[0] * lengths[0], b = lengths[1] * lengths[1], c = lengths[2] * lengths[2], s = 1 / (8 * area);
  return {2 * s * a, 2 * s * b, 2 * s * c, -s * (b + c - a), -s * (c + a - b), -s * (a + b - c)};
}

ElementMatrix mass_element(double area) { return {area / 6, area / 6, area / 6, area / 12, area / 12, area / 12}; }

Laplacian cotangent_laplacian(const IntrinsicMesh& mesh, Eigen::Index vertex_count) {
  const SparseMatrix pattern = edge_pattern({&mesh.faces}, vertex_count);
  const ElementAssembler assembler(pattern, mesh.faces);
  const Eigen::VectorXd areas = face_areas(mesh);
  Laplacian result{pattern, pattern};
  assembler.assemble(result.stiffness, [&](Eigen::Index f) { return stiffness_element(mesh.lengths.row(f), areas[f]); });
  assembler.assemble(result.mass, [&](Eigen::Index f) { return mass_element(areas[f]); });
  return result;
}

}  // namespace spherematch
