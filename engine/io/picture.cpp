#include "engine/io/picture.h"

#include <png.h>

#include <Eigen/Geometry>
#include <cmath>
#include <stdexcept>

#include "engine/io/float_range.h"

namespace spherematch {

Eigen::VectorXd vertex_areas(const TriMesh& mesh) {
  Eigen::VectorXd areas = Eigen::VectorXd::Zero(mesh.vertex_count());
  for (Eigen::Index f = 0; f < mesh.face_count(); ++f) {
    const Eigen::RowVector3d a = mesh.vertices.row(mesh.faces(f, 0));
    const double area = (mesh.vertices.row(mesh.faces(f, 1)) - a).cross(mesh.vertices.row(mesh.faces(f, 2)) - a).norm() / 2;
    for (int k = 0; k < 3; ++k) areas(mesh.faces(f, k)) += area / 3;
  }
  return areas;
}

TriMesh with_unit_area(const TriMesh& mesh) {
  const Box box = box_of(mesh.vertices);
  TriMesh result{.vertices = (mesh.vertices.rowwise() - box.center()) / box.radius(), .faces = mesh.faces};
  result.vertices /= std::sqrt(vertex_areas(result).sum());
  return result;
}

double center_view(Scene& scene) {
  const Box seen = box_of(scene.mesh.vertices * scene.axes.transpose());
  scene.center = scene.axes.transpose() * seen.center().transpose();
  return (seen.high - seen.low).head<2>().maxCoeff();
}

std::string png_of(const Image& image) {
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  header.width = static_cast<png_uint_32>(image.width);
  header.height = static_cast<png_uint_32>(image.height);
  header.format = image.background == Background::white ? PNG_FORMAT_RGB : PNG_FORMAT_RGBA;
  std::string bytes(PNG_IMAGE_PNG_SIZE_MAX(header), '\0');
  png_alloc_size_t size = bytes.size();
  if (png_image_write_to_memory(&header, bytes.data(), &size, 0, image.pixels.data(), 0, nullptr) == 0) {
    throw std::runtime_error(std::string("writing a PNG failed: ") + header.message);
  }
  bytes.resize(size);
  return bytes;
}

}  // namespace spherematch
