#include "engine/mesh/spatial_order.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace spherematch {
namespace {

/// The lowest 21 bits of x with two zeros between neighbours.
std::uint64_t spread_bits(std::uint64_t x) {
  std::uint64_t result = 0;
  for (unsigned bit = 0; bit < 21; ++bit) result |= (x >> bit & 1) << 3 * bit;
  return result;
}

std::vector<std::pair<std::uint64_t, std::int32_t>> sorted_codes(const Points& points) {
  const Eigen::RowVector3d low = points.colwise().minCoeff(), size = points.colwise().maxCoeff() - low;
  const double scale = size.maxCoeff() > 0 ? 0x1fffff / size.maxCoeff() : 0;
  std::vector<std::pair<std::uint64_t, std::int32_t>> codes;
  codes.reserve(static_cast<std::size_t>(points.rows()));
  for (Eigen::Index v = 0; v < points.rows(); ++v) {
    std::uint64_t code = 0;
    for (int k = 0; k < 3; ++k) code |= spread_bits(static_cast<std::uint64_t>(scale * (points(v, k) - low[k]))) << k;
    codes.emplace_back(code, static_cast<std::int32_t>(v));
  }
  std::sort(codes.begin(), codes.end());
  return codes;
}

}  // namespace

OrderedMesh spatially_ordered(const TriMesh& mesh) {
  OrderedMesh result{mesh, {}};
  std::vector<std::int32_t> number(static_cast<std::size_t>(mesh.vertex_count()));
  for (const auto& [code, v] : sorted_codes(mesh.vertices)) {
    number[static_cast<std::size_t>(v)] = static_cast<std::int32_t>(result.original.size());
    result.original.push_back(v);
  }
  result.mesh.vertices = to_ordered(result, mesh.vertices);

  // Faces by counting, since their keys are dense.
  const auto renumbered = [&](Eigen::Index f, int k) { return number[static_cast<std::size_t>(mesh.faces(f, k))]; };
  const auto key = [&](Eigen::Index f) {
    return static_cast<std::size_t>(std::min({renumbered(f, 0), renumbered(f, 1), renumbered(f, 2)}));
  };
  std::vector<Eigen::Index> next(number.size() + 1, 0);
  for (Eigen::Index f = 0; f < mesh.face_count(); ++f) ++next[key(f) + 1];
  for (std::size_t v = 1; v < next.size(); ++v) next[v] += next[v - 1];
  for (Eigen::Index f = 0; f < mesh.face_count(); ++f)
    result.mesh.faces.row(next[key(f)]++) << renumbered(f, 0), renumbered(f, 1), renumbered(f, 2);
  return result;
}

Points to_ordered(const OrderedMesh& order, const Points& values) {
  Points result(values.rows(), 3);
  for (std::size_t v = 0; v < order.original.size(); ++v) result.row(static_cast<Eigen::Index>(v)) = values.row(order.original[v]);
  return result;
}

Points to_original(const OrderedMesh& order, const Points& values) {
  Points result(values.rows(), 3);
  for (std::size_t v = 0; v < order.original.size(); ++v) result.row(order.original[v]) = values.row(static_cast<Eigen::Index>(v));
  return result;
}

}  // namespace spherematch
