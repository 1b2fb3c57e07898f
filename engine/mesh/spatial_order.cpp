#include "engine/mesh/spatial_order.h"

#include <algorithm>
#include <numeric>

namespace spherematch {

namespace {

std::size_t at(std::int64_t index) { return static_cast<std::size_t>(index); }

}  // namespace

std::vector<std::int32_t> spatial_order(const Points& points) {
  constexpr double kCells = 1024;  // a side: ten bits
  const Eigen::RowVector3d low = points.colwise().minCoeff();
  const double size = (points.colwise().maxCoeff() - low).maxCoeff(), scale = size > 0 ? (kCells - 1) / size : 0;
  const auto spread = [](std::uint64_t bits) {  // two zeros after each of ten bits
    bits = (bits | bits << 16) & 0x030000FF;
    bits = (bits | bits << 8) & 0x0300F00F;
    bits = (bits | bits << 4) & 0x030C30C3;
    return (bits | bits << 2) & 0x09249249;
  };
  std::vector<std::uint64_t> keys(at(points.rows()));
  for (std::size_t v = 0; v < keys.size(); ++v) {
    const Eigen::RowVector3d cell = (points.row(static_cast<Eigen::Index>(v)) - low) * scale;
    std::uint64_t code = 0;
    for (int k = 0; k < 3; ++k) code |= spread(static_cast<std::uint64_t>(cell[k])) << k;
    keys[v] = code << 32 | v;
  }
  std::sort(keys.begin(), keys.end());
  std::vector<std::int32_t> order(keys.size());
  std::transform(keys.begin(), keys.end(), order.begin(), [](std::uint64_t key) { return static_cast<std::int32_t>(key & 0xFFFFFFFF); });
  return order;
}

TriMesh renumbered(const TriMesh& mesh, const std::vector<std::int32_t>& order) {
  TriMesh result{Points(mesh.vertex_count(), 3), Triangles(mesh.face_count(), 3)};
  std::vector<std::int32_t> number(order.size()), start(order.size() + 1, 0);
  for (std::size_t i = 0; i < order.size(); ++i) {
    number[at(order[i])] = static_cast<std::int32_t>(i);
    result.vertices.row(static_cast<Eigen::Index>(i)) = mesh.vertices.row(order[i]);
  }
  const auto corners = [&](Eigen::Index f) {
    return Eigen::RowVector3i(number[at(mesh.faces(f, 0))], number[at(mesh.faces(f, 1))], number[at(mesh.faces(f, 2))]);
  };
  for (Eigen::Index f = 0; f < mesh.face_count(); ++f) ++start[at(corners(f).minCoeff()) + 1];
  std::partial_sum(start.begin(), start.end(), start.begin());
  for (Eigen::Index f = 0; f < mesh.face_count(); ++f) {
    const Eigen::RowVector3i c = corners(f);
    result.faces.row(start[at(c.minCoeff())]++) = c;
  }
  return result;
}

}  // namespace spherematch
