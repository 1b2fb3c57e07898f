#include "engine/io/map_picture.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "engine/io/camera.h"
#include "engine/io/map_mesh.h"
#include "engine/io/picture.h"

namespace spherematch {

namespace {

constexpr int side = 600;
constexpr int margin = 24;

/// Rows of `values`, one for each uploaded vertex, brought to the vertices of the surface; NaN at an added vertex.
Points on_surface(const Points& values, const Surface& surface) {
  if (values.rows() != surface.uploaded_vertices()) throw std::invalid_argument("the map is of another source than the picture");
  Points result = Points::Constant(surface.mesh.vertex_count(), 3, std::numeric_limits<double>::quiet_NaN());
  for (std::int32_t v = 0; v < surface.uploaded_vertices(); ++v) {
    const std::int32_t vertex = surface.surface_vertex[static_cast<std::size_t>(v)];
    if (vertex >= 0) result.row(vertex) = values.row(v);
  }
  // Copies of a vertex that was split are known by the corners of their faces alone.
  for (Eigen::Index f = 0; f < surface.mesh.face_count(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const std::int32_t uploaded = surface.uploaded_corners(f, k);
      if (uploaded >= 0) result.row(surface.mesh.faces(f, k)) = values.row(uploaded);
    }
  }
  return result;
}

/// The surfaces at unit area, the target turned as the source is seen. `images` and `left_paint` speak of the source's surface,
/// `right_paint` of the target's.
std::string draw_pair(const Surface& source, const Surface& target, const Points& images, Paint kind, const Points& left_paint,
                      const Points& right_paint) {
  const TriMesh left = with_unit_area(source.mesh);
  const TriMesh right = with_unit_area(target.mesh);
  const Pose pose = upright_pose(left);
  const Eigen::Matrix3d rotation = best_rotation(images, left.vertices, vertex_areas(left));
  Scene left_scene{left, left_paint, view_axes(pose), {}, 1, kind};
  Scene right_scene{right, right_paint, view_axes(corresponding_pose(pose, rotation)), {}, 1, kind};
  const double larger = std::max(center_view(left_scene), center_view(right_scene));
  left_scene.pixels_per_unit = right_scene.pixels_per_unit = (side - 2 * margin) / larger;

  Image image(2 * side, side);
  render(left_scene, image, 0);
  render(right_scene, image, side);
  return png_of(image);
}

}  // namespace

std::string encode_png(const Correspondence& map, const Surface& source, const Surface& target) {
  const Points images = on_surface(image_points(map, target), source);
  return draw_pair(source, target, images, Paint::color, normalized_coordinates(images, target),
                   normalized_coordinates(target.mesh.vertices, target));
}

std::string encode_png(const VertexDataPair& data, const Correspondence& map, const Surface& source, const Surface& target) {
  const Paint kind = data.source.meaning == Meaning::texture ? Paint::checker : Paint::color;
  return draw_pair(source, target, on_surface(image_points(map, target), source), kind, on_surface(data.source.paint, source),
                   on_surface(data.target.paint, target));
}

}  // namespace spherematch
