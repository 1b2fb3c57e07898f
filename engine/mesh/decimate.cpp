#include "engine/mesh/decimate.h"

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_simplification/Edge_collapse_visitor_base.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Bounded_normal_change_filter.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Edge_length_cost.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Midpoint_placement.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>

#include <Eigen/Geometry>
#include <array>
#include <chrono>
#include <limits>
#include <numeric>
#include <vector>

#include "engine/mesh/closest_point.h"
#include "engine/mesh/topology.h"

namespace spherematch {

namespace {

namespace sms = CGAL::Surface_mesh_simplification;
using Kernel = CGAL::Simple_cartesian<double>;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

std::size_t at(std::int64_t index) { return static_cast<std::size_t>(index); }

/// Coordinates of about one: costs then neither overflow nor depend on the unit of length.
struct Normalization {
  Eigen::RowVector3d center;
  double size;

  explicit Normalization(const Points& points) {
    const Eigen::RowVector3d low = points.colwise().minCoeff(), high = points.colwise().maxCoeff();
    center = 0.5 * low + 0.5 * high;
    size = (0.5 * high - 0.5 * low).maxCoeff();
  }
  [[nodiscard]] Points apply(const Points& points) const { return (points.rowwise() - center) / size; }
  [[nodiscard]] Points undo(const Points& points) const { return (size * points).rowwise() + center; }
};

/// Each collapse costs time with the number of faces round it, which a vertex of very many faces makes quadratic.
bool is_tractable(const TriMesh& mesh) {
  constexpr double kMost = 200;  // mean square of the number of faces round a vertex; 36 on a regular mesh
  Eigen::ArrayXd valence = Eigen::ArrayXd::Zero(mesh.vertex_count());
  for (Eigen::Index i = 0; i < mesh.faces.size(); ++i) valence[mesh.faces.data()[i]] += 1;
  return valence.square().mean() < kMost;
}

/// Stops at the wanted number of edges, or when collapses take far more than the usual work.
class Stop {
 public:
  /// CGAL asks a const copy, so what is left of the work is the caller's.
  Stop(std::int64_t edges, std::int64_t& work) : edges_(edges), work_(work) {}

  template <typename Cost, typename Profile>
  bool operator()(const Cost&, const Profile& profile, std::size_t, std::size_t current) const {
    work_ -= static_cast<std::int64_t>(profile.link().size());
    return static_cast<std::int64_t>(current) <= edges_ || work_ < 0;
  }

 private:
  std::int64_t edges_;
  std::int64_t& work_;
};

/// Notes which vertex each removed one went into.
struct Follower : sms::Edge_collapse_visitor_base<Mesh> {
  explicit Follower(std::vector<std::int32_t>& collapsed_into) : into(collapsed_into) {}

  void OnCollapsed(const Profile& profile, const vertex_descriptor& kept) {
    const vertex_descriptor gone = profile.v0() == kept ? profile.v1() : profile.v0();
    into[gone] = static_cast<std::int32_t>(kept.idx());
  }

  std::vector<std::int32_t>& into;
};

Mesh cgal_mesh(const Points& points, const Triangles& faces) {
  Mesh result;
  const auto size = [](std::int64_t count) { return static_cast<Mesh::size_type>(count); };
  result.reserve(size(points.rows()), size(faces.rows() * 3 / 2), size(faces.rows()));
  for (Eigen::Index v = 0; v < points.rows(); ++v) result.add_vertex({points(v, 0), points(v, 1), points(v, 2)});
  const auto corner = [&](Eigen::Index f, int k) { return Mesh::Vertex_index(size(faces(f, k))); };
  for (Eigen::Index f = 0; f < faces.rows(); ++f) result.add_face(corner(f, 0), corner(f, 1), corner(f, 2));
  return result;
}

/// What is left of the mesh; `number` becomes the new number of each vertex that is left, else -1.
TriMesh remaining(const Mesh& mesh, std::vector<std::int32_t>& number) {
  TriMesh result;
  result.vertices.resize(static_cast<Eigen::Index>(mesh.number_of_vertices()), 3);
  result.faces.resize(static_cast<Eigen::Index>(mesh.number_of_faces()), 3);
  std::int32_t next = 0;
  for (const Mesh::Vertex_index v : mesh.vertices()) {
    const Kernel::Point_3& p = mesh.point(v);
    result.vertices.row(next) << p.x(), p.y(), p.z();
    number[v] = next++;
  }
  Eigen::Index row = 0;
  for (const Mesh::Face_index f : mesh.faces()) {
    int k = 0;
    for (const Mesh::Vertex_index v : mesh.vertices_around_face(mesh.halfedge(f))) result.faces(row, k++) = number[v];
    ++row;
  }
  return result;
}

/// Collapses keep the mesh closed and manifold; that they kept its size and its outside is found out.
bool is_usable(const TriMesh& mesh) {
  if (!mesh.vertices.allFinite() || euler_characteristic(mesh.faces) != 2) return false;
  double area = 0, volume = 0;
  for (Eigen::Index f = 0; f < mesh.face_count(); ++f) {
    const Eigen::Vector3d a = mesh.vertices.row(mesh.faces(f, 0)), b = mesh.vertices.row(mesh.faces(f, 1)),
                          c = mesh.vertices.row(mesh.faces(f, 2));
    area += (b - a).cross(c - a).norm();
    volume += a.dot(b.cross(c));
  }
  return area > 0 && volume > 0;
}

/// Finds nearest points by walking over the mesh.
class Walker {
 public:
  explicit Walker(const TriMesh& mesh) : mesh_(mesh), around_(vertex_faces(mesh.faces, mesh.vertex_count())) {}

  /// From face to neighbouring face, starting round `vertex`, while that brings it nearer to `point`.
  [[nodiscard]] SurfacePoint nearest(const Eigen::Vector3d& point, std::int32_t vertex) const {
    SurfacePoint best;
    double distance = std::numeric_limits<double>::infinity();
    visit(point, vertex, best, distance);
    for (std::int32_t from = -1; from != best.face;) {
      from = best.face;
      for (int k = 0; k < 3; ++k) visit(point, mesh_.faces(from, k), best, distance);
    }
    return best;
  }

 private:
  void visit(const Eigen::Vector3d& point, std::int32_t vertex, SurfacePoint& best, double& distance) const {
    for (const std::int32_t face : around_.of(vertex)) {
      const std::array<Eigen::Vector3d, 3> corners{corner(face, 0), corner(face, 1), corner(face, 2)};
      const std::array<double, 3> weights = nearest_weights(corners, point);
      const double d = (weights[0] * corners[0] + weights[1] * corners[1] + weights[2] * corners[2] - point).squaredNorm();
      if (!(d < distance)) continue;
      distance = d;
      best = {face, weights};
    }
  }

  [[nodiscard]] Eigen::Vector3d corner(std::int32_t face, int k) const { return mesh_.vertices.row(mesh_.faces(face, k)); }

  const TriMesh& mesh_;
  VertexFaces around_;
};

}  // namespace

std::optional<DecimatedMesh> decimate(const TriMesh& mesh, std::int32_t vertices) {
  const auto start = std::chrono::steady_clock::now();
  const Normalization frame(mesh.vertices);
  if (mesh.vertex_count() <= vertices || !is_tractable(mesh) || !(frame.size > 0)) return std::nullopt;
  const Points points = frame.apply(mesh.vertices);
  Mesh work = cgal_mesh(points, mesh.faces);
  std::vector<std::int32_t> into(at(points.rows()));
  std::iota(into.begin(), into.end(), 0);
  // Shortest edges first: triangles of even size and shape are what the parametrisation of a thin limb needs. Costs
  // that follow the surface more closely leave uneven ones, of which only the last resorts make a sphere (docs/method.md).
  std::int64_t most_work = 100 * points.rows();
  sms::edge_collapse(work, Stop(3 * (std::int64_t{vertices} - 2), most_work),
                     CGAL::parameters::get_cost(sms::Edge_length_cost<Mesh>())
                         .get_placement(sms::Midpoint_placement<Mesh>())
                         .filter(sms::Bounded_normal_change_filter<>())
                         .visitor(Follower(into)));

  std::vector<std::int32_t> number(into.size(), -1);
  DecimatedMesh result{remaining(work, number), {}};
  if (!is_usable(result.mesh)) return std::nullopt;
  const Walker walker(result.mesh);
  result.places.reserve(into.size());
  for (std::size_t v = 0; v < into.size(); ++v) {
    auto home = static_cast<std::int32_t>(v);
    while (into[at(home)] != home) home = into[at(home)] = into[at(into[at(home)])];
    result.places.push_back(walker.nearest(points.row(static_cast<Eigen::Index>(v)), number[at(home)]));
    if (result.places.back().face < 0) return std::nullopt;  // distances that are no numbers
  }
  result.mesh.vertices = frame.undo(result.mesh.vertices);
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

}  // namespace spherematch
