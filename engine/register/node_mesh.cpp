#include "engine/register/node_mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "engine/sphere/icosphere.h"

namespace spherematch {
namespace {

constexpr std::size_t kMostNeighbours = 6;  ///< of a node of an icosphere

}  // namespace

TangentFrame tangent_frame(const Eigen::Vector3d& p) {
  const Eigen::Vector3d across = std::abs(p.z()) < 0.9 ? Eigen::Vector3d::UnitZ() : Eigen::Vector3d::UnitX();
  const Eigen::Vector3d first = across.cross(p).normalized();
  TangentFrame result;
  result << first, p.cross(first);
  return result;
}

NodeMesh::NodeMesh(int subdivisions) : mesh_(icosphere(subdivisions)), repair_(mesh_), areas_(Eigen::VectorXd::Zero(mesh_.vertex_count())) {
  for (Eigen::Index f = 0; f < faces().rows(); ++f) {
    Eigen::Vector3d p[3];
    for (int k = 0; k < 3; ++k) p[k] = nodes().row(faces()(f, k));
    for (int k = 0; k < 3; ++k) areas_[faces()(f, k)] += (p[1] - p[0]).cross(p[2] - p[0]).norm() / 6;
  }
  find_parents(subdivisions);
  find_faces();
  make_pattern();
}

void NodeMesh::find_parents(int subdivisions) {
  for (std::int32_t i = 0; i < static_cast<std::int32_t>(count()); ++i) parents_.push_back({i, i});
  if (subdivisions == 0) return;
  // Of every four faces the first three each have one corner of the face that was split.
  for (Eigen::Index f = 0; f < faces().rows(); f += 4) {
    const std::int32_t corners[3] = {faces()(f, 0), faces()(f + 1, 1), faces()(f + 2, 2)};
    const std::int32_t middles[3] = {faces()(f, 1), faces()(f + 1, 2), faces()(f + 2, 0)};
    for (int k = 0; k < 3; ++k) parents_[static_cast<std::size_t>(middles[k])] = {corners[k], corners[(k + 1) % 3]};
  }
}

void NodeMesh::find_faces() {
  start_.assign(static_cast<std::size_t>(count()) + 1, 0);
  for (Eigen::Index i = 0; i < faces().size(); ++i) ++start_[static_cast<std::size_t>(faces().data()[i]) + 1];
  for (std::size_t v = 1; v < start_.size(); ++v) start_[v] += start_[v - 1];
  face_.resize(static_cast<std::size_t>(faces().size()));
  std::vector<std::int32_t> next(start_.begin(), start_.end() - 1);
  for (std::int32_t f = 0; f < static_cast<std::int32_t>(faces().rows()); ++f)
    for (int k = 0; k < 3; ++k) face_[static_cast<std::size_t>(next[static_cast<std::size_t>(faces()(f, k))]++)] = f;
}

void NodeMesh::make_pattern() {
  pattern_.start.push_back(0);
  for (std::size_t node = 0; node + 1 < start_.size(); ++node) {
    std::vector<std::int32_t> columns;
    for (std::int32_t j = start_[node]; j < start_[node + 1]; ++j)
      for (int k = 0; k < 3; ++k) columns.push_back(faces()(face_[static_cast<std::size_t>(j)], k));
    std::sort(columns.begin(), columns.end());
    columns.erase(std::unique(columns.begin(), columns.end()), columns.end());
    pattern_.column.insert(pattern_.column.end(), columns.begin(), columns.end());
    pattern_.start.push_back(static_cast<std::int32_t>(pattern_.column.size()));
    node_slots_.push_back(pattern_.slot(static_cast<std::int32_t>(node), static_cast<std::int32_t>(node)));
  }
  for (Eigen::Index f = 0; f < faces().rows(); ++f) {
    FaceSlots slots;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j)
        slots[3 * i + j] = pattern_.slot(faces()(f, static_cast<Eigen::Index>(i)), faces()(f, static_cast<Eigen::Index>(j)));
    face_slots_.push_back(slots);
  }
}

void NodeMesh::differentiate(const PointValues& values, const Points& places, const std::vector<TangentFrame>& frames, Eigen::Index first,
                             Eigen::Index last, PointValues& result) const {
  const Eigen::Index c = values.cols();
  for (Eigen::Index i = first; i < last; ++i) {
    const auto node = static_cast<std::size_t>(i);
    // What the value at each of the node's neighbours, and its own, adds to the derivatives: few, while there may be many functions.
    const std::int32_t first_slot = pattern_.start[node];
    std::array<Eigen::Vector2d, kMostNeighbours + 1> shares;
    shares.fill(Eigen::Vector2d::Zero());
    double area = 0;
    for (std::int32_t j = start_[node]; j < start_[node + 1]; ++j) {
      const std::int32_t f = face_[static_cast<std::size_t>(j)];
      const auto face = faces().row(f);
      const Eigen::Vector3d p[3] = {places.row(face[0]), places.row(face[1]), places.row(face[2])};
      const Eigen::Vector3d normal = (p[1] - p[0]).cross(p[2] - p[0]);
      const double size = normal.norm();
      if (!(size > 0)) continue;
      area += size;
      const std::size_t self = face[0] == i ? 0 : face[1] == i ? 1 : 2;
      for (int k = 0; k < 3; ++k) {
        const std::int32_t slot = face_slots_[static_cast<std::size_t>(f)][3 * self + static_cast<std::size_t>(k)];
        shares[static_cast<std::size_t>(slot - first_slot)] +=
            frames[node].transpose() * (normal / size).cross(p[(k + 2) % 3] - p[(k + 1) % 3]);  // times twice the area
      }
    }
    auto row = result.row(i);
    row.setZero();
    if (!(area > 0)) continue;
    for (std::int32_t slot = first_slot; slot < pattern_.start[node + 1]; ++slot) {
      const Eigen::Vector2f share = (shares[static_cast<std::size_t>(slot - first_slot)] / area).cast<float>();
      const auto neighbour = values.row(pattern_.column[static_cast<std::size_t>(slot)]);
      row.head(c) += share[0] * neighbour;
      row.tail(c) += share[1] * neighbour;
    }
  }
}

}  // namespace spherematch
