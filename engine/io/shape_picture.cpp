#include "engine/io/shape_picture.h"

#include <algorithm>
#include <stdexcept>
#include <vector>

#include "engine/io/camera.h"
#include "engine/io/picture.h"
#include "engine/io/polygon_fans.h"

namespace spherematch {

namespace {

const Eigen::RowVector3d slate(0.50, 0.62, 0.76);  ///< neither vanishes on white nor on black

/// The triangles of the mesh and the vertices that have some: a vertex by itself, however far away, is nothing to see.
TriMesh visible_part(const PolygonMesh& mesh) {
  const std::vector<std::uint32_t> corners = fan_triangles(mesh, mesh.vertices);
  std::vector<std::int32_t> place(static_cast<std::size_t>(mesh.vertex_count()), -1);
  TriMesh result{.vertices = Points(mesh.vertex_count(), 3), .faces = Triangles(static_cast<Eigen::Index>(corners.size() / 3), 3)};
  std::int32_t count = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    std::int32_t& vertex = place[corners[i]];
    if (vertex < 0) {
      vertex = count++;
      result.vertices.row(vertex) = mesh.vertices.row(corners[i]);
    }
    result.faces(static_cast<Eigen::Index>(i / 3), static_cast<Eigen::Index>(i % 3)) = vertex;
  }
  result.vertices.conservativeResize(count, 3);
  return result;
}

}  // namespace

std::string encode_thumbnail(const PolygonMesh& mesh, int size, const std::optional<Viewpoint>& view) {
  if (size < least_thumbnail || size > largest_thumbnail) throw std::invalid_argument("the picture has no such size");
  const TriMesh shape = with_unit_area(visible_part(mesh));
  if (!shape.vertices.allFinite()) throw std::invalid_argument("the mesh has no area");
  const Points paint = slate.replicate(shape.vertex_count(), 1);
  const Pose pose = view ? Pose{view->up, view->front} : upright_pose(shape);
  Scene scene{.mesh = shape, .paint = paint, .axes = view_axes(pose), .center = {}, .pixels_per_unit = 1, .two_sided = true};
  const int margin = std::max(1, size / 32);
  scene.pixels_per_unit = (size - 2 * margin) / center_view(scene);
  Image image(size, size, Background::transparent);
  render(scene, image, 0);
  return png_of(image);
}

}  // namespace spherematch
