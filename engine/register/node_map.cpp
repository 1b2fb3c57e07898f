#include "engine/register/node_map.h"

#include <cmath>
#include <numbers>

#include "engine/register/composition.h"
#include "engine/register/point_location.h"
#include "engine/sphere/orientation.h"

namespace spherematch {
namespace {

Points carried(const Points& points, const Points& from, const Points& to, const Triangles& faces, int threads) {
  const PointLocation location(from, faces);
  const std::vector<Location> places = locate_all(points, location, threads);
  Points result(points.rows(), 3);
  for (Eigen::Index i = 0; i < result.rows(); ++i) {
    const Location& at = places[static_cast<std::size_t>(i)];
    Eigen::RowVector3d image = Eigen::RowVector3d::Zero();
    for (int k = 0; k < 3; ++k) image += at.bary[k] * to.row(faces(at.face, k));
    result.row(i) = image.normalized();
  }
  return result;
}

bool covers_once(const Points& sphere, const Triangles& faces) {
  constexpr double kRounding = 1e-6;
  return flipped_faces(sphere, faces).empty() && std::abs(total_solid_angle(sphere, faces) - 4 * std::numbers::pi) < kRounding;
}

}  // namespace

NodeMap::NodeMap(const NodeMesh& mesh, const FlowSide& source, const FlowSide& target)
    : mesh_(&mesh), source_(source.origins(mesh.nodes())), target_(target.origins(mesh.nodes())) {
  // What cannot be turned back is left as it is, and bijective() says so.
  for (Points* places : {&source_, &target_}) (void)mesh.repair().repair(*places);
}

void NodeMap::follow(const NodeMap& coarse) {
  follow(coarse.source_, source_);
  follow(coarse.target_, target_);
}

void NodeMap::follow(const Points& coarse, Points& fine) const {
  const Points moves = coarse - fine.topRows(coarse.rows());
  for (Eigen::Index i = 0; i < fine.rows(); ++i) {
    const auto& [a, b] = mesh_->parents(i);
    fine.row(i) = i < moves.rows() ? coarse.row(i) : Eigen::RowVector3d((fine.row(i) + (moves.row(a) + moves.row(b)) / 2).normalized());
  }
  (void)mesh_->repair().repair(fine);
}

Points NodeMap::forward(const Points& points, int threads) const { return carried(points, source_, target_, mesh_->faces(), threads); }

Points NodeMap::backward(const Points& points, int threads) const { return carried(points, target_, source_, mesh_->faces(), threads); }

bool NodeMap::bijective() const { return covers_once(source_, mesh_->faces()) && covers_once(target_, mesh_->faces()); }

}  // namespace spherematch
