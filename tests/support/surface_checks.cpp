#include "tests/support/surface_checks.h"

#include <Eigen/Geometry>
#include <map>
#include <numeric>
#include <set>
#include <vector>

namespace spherematch::test {

namespace {

using HalfEdges = std::map<std::pair<std::int32_t, std::int32_t>, Eigen::Index>;

HalfEdges half_edges_of(const Triangles& faces) {
  HalfEdges half_edges;
  for (Eigen::Index f = 0; f < faces.rows(); ++f)
    for (int k = 0; k < 3; ++k) {
      const bool fresh = half_edges.try_emplace({faces(f, k), faces(f, (k + 1) % 3)}, f).second;
      EXPECT_TRUE(fresh) << "two faces run from vertex " << faces(f, k) << " to " << faces(f, (k + 1) % 3);
    }
  return half_edges;
}

/// The faces at a vertex, walked from one to the next across edges, must be all that there are.
void expect_one_fan_each(const TriMesh& mesh, const HalfEdges& half_edges) {
  std::map<std::int32_t, std::map<std::int32_t, std::int32_t>> next_of;  // round each vertex: from one neighbour to the next
  for (Eigen::Index f = 0; f < mesh.face_count(); ++f)
    for (int k = 0; k < 3; ++k) next_of[mesh.faces(f, k)][mesh.faces(f, (k + 1) % 3)] = mesh.faces(f, (k + 2) % 3);
  ASSERT_EQ(static_cast<Eigen::Index>(next_of.size()), mesh.vertex_count()) << "a vertex has no face";
  for (const auto& [vertex, next] : next_of) {
    std::size_t steps = 0;
    std::int32_t at = next.begin()->first;
    do {
      const auto found = next.find(at);
      ASSERT_NE(found, next.end()) << "the faces at vertex " << vertex << " are no closed fan";
      at = found->second;
      ++steps;
    } while (at != next.begin()->first && steps <= next.size());
    ASSERT_EQ(steps, next.size()) << "vertex " << vertex << " has several fans";
  }
  ASSERT_EQ(half_edges.size(), static_cast<std::size_t>(3 * mesh.face_count()));
}

void expect_connected(const TriMesh& mesh) {
  std::vector<std::int32_t> parent(static_cast<std::size_t>(mesh.vertex_count()));
  std::iota(parent.begin(), parent.end(), 0);
  const auto find = [&](std::int32_t v) {
    while (parent[static_cast<std::size_t>(v)] != v) v = parent[static_cast<std::size_t>(v)];
    return v;
  };
  for (Eigen::Index f = 0; f < mesh.face_count(); ++f)
    for (int k = 1; k < 3; ++k) parent[static_cast<std::size_t>(find(mesh.faces(f, k)))] = find(mesh.faces(f, 0));
  std::set<std::int32_t> roots;
  for (Eigen::Index v = 0; v < mesh.vertex_count(); ++v) roots.insert(find(static_cast<std::int32_t>(v)));
  EXPECT_EQ(roots.size(), 1U) << "the surface has several components";
}

void expect_references(const Surface& surface, const PolygonMesh& upload) {
  ASSERT_EQ(surface.uploaded_vertices(), upload.vertex_count());
  ASSERT_EQ(surface.uploaded_faces, upload.face_count());
  ASSERT_EQ(surface.uploaded_corners.rows(), surface.mesh.face_count());
  std::int32_t dropped = 0;
  for (std::int32_t u = 0; u < upload.vertex_count(); ++u) {
    const std::int32_t v = surface.surface_vertex[static_cast<std::size_t>(u)];
    ASSERT_GE(v, -1);
    ASSERT_LT(v, surface.mesh.vertex_count());
    if (v < 0)
      ++dropped;
    else
      ASSERT_EQ(surface.mesh.vertices.row(v), upload.vertices.row(u)) << "uploaded vertex " << u << " has moved";
  }
  EXPECT_EQ(dropped, surface.report.dropped_vertices);
  for (Eigen::Index f = 0; f < surface.mesh.face_count(); ++f)
    for (int k = 0; k < 3; ++k) {
      const std::int32_t u = surface.uploaded_corners(f, k);
      ASSERT_GE(u, -1);
      ASSERT_LT(u, upload.vertex_count());
      if (u < 0) continue;
      ASSERT_EQ(surface.mesh.vertices.row(surface.mesh.faces(f, k)), upload.vertices.row(u)) << "corner " << k << " of face " << f;
      ASSERT_GE(surface.surface_vertex[static_cast<std::size_t>(u)], 0) << "a dropped vertex has a face";
    }
}

}  // namespace

void expect_invariants(const Surface& surface, const PolygonMesh& upload) {
  const TriMesh& mesh = surface.mesh;
  ASSERT_GE(mesh.vertex_count(), 4);
  ASSERT_GE(mesh.faces.minCoeff(), 0);
  ASSERT_LT(mesh.faces.maxCoeff(), mesh.vertex_count());
  EXPECT_TRUE(mesh.vertices.allFinite());
  const HalfEdges half_edges = half_edges_of(mesh.faces);
  for (const auto& [ends, face] : half_edges)
    ASSERT_TRUE(half_edges.contains({ends.second, ends.first})) << "face " << face << " has a boundary edge";
  expect_one_fan_each(mesh, half_edges);
  expect_connected(mesh);
  EXPECT_EQ(mesh.vertex_count() - static_cast<Eigen::Index>(half_edges.size() / 2) + mesh.face_count(), 2);
  EXPECT_GT(signed_volume(mesh), 0);
  expect_references(surface, upload);
}

double signed_volume(const TriMesh& mesh) {
  const Eigen::RowVector3d origin = mesh.vertices.colwise().mean();
  double volume = 0;
  for (Eigen::Index f = 0; f < mesh.face_count(); ++f) {
    const Eigen::RowVector3d a = mesh.vertices.row(mesh.faces(f, 0)) - origin;
    const Eigen::RowVector3d b = mesh.vertices.row(mesh.faces(f, 1)) - origin;
    const Eigen::RowVector3d c = mesh.vertices.row(mesh.faces(f, 2)) - origin;
    volume += a.dot(b.cross(c)) / 6;
  }
  return volume;
}

double total_area(const TriMesh& mesh) {
  double area = 0;
  for (Eigen::Index f = 0; f < mesh.face_count(); ++f) {
    const Eigen::RowVector3d a = mesh.vertices.row(mesh.faces(f, 0));
    area += 0.5 * (mesh.vertices.row(mesh.faces(f, 1)) - a).cross(mesh.vertices.row(mesh.faces(f, 2)) - a).norm();
  }
  return area;
}

OffendingElements expect_refusal(ErrorCode code, const std::function<void()>& action) {
  try {
    action();
  } catch (const EngineError& error) {
    EXPECT_EQ(error.code(), code) << error.what();
    EXPECT_NE(std::string(error.what()), "");
    return error.elements();
  }
  ADD_FAILURE() << "nothing was refused";
  return {};
}

}  // namespace spherematch::test
