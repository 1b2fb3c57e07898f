#include "engine/io/mesh_writer.h"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <utility>

#include "engine/io/float_range.h"
#include "engine/io/glb_file.h"
#include "engine/io/number_output.h"
#include "engine/io/ply_faces.h"
#include "engine/io/polygon_fans.h"

namespace spherematch {

namespace {

constexpr std::array<std::pair<std::string_view, MeshFormat>, 5> formats{
    {{"off", MeshFormat::off}, {"obj", MeshFormat::obj}, {"ply", MeshFormat::ply}, {"stl", MeshFormat::stl}, {"glb", MeshFormat::glb}}};

/// The rows of a text format: `vertex` and `face` start them, and indices count from `first`.
void append_rows(std::string& text, const PolygonMesh& mesh, const char* vertex, const char* face, std::int32_t first, bool counted) {
  text.reserve(text.size() + static_cast<std::size_t>(mesh.vertex_count()) * 60 + mesh.indices.size() * 9);
  for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v) {
    text += vertex;
    for (int k = 0; k < 3; ++k) append_text(text += k > 0 ? " " : "", mesh.vertices(v, k));
    text += '\n';
  }
  for (std::int32_t f = 0; f < mesh.face_count(); ++f) {
    const auto corners = mesh.face(f);
    text += face;
    if (counted) append_text(text, corners.size());
    for (const std::int32_t corner : corners) append_text(text += ' ', corner + first);
    text += '\n';
  }
}

std::string encode_off(const PolygonMesh& mesh) {
  std::string text = "OFF\n" + std::to_string(mesh.vertex_count()) + ' ' + std::to_string(mesh.face_count()) + " 0\n";
  append_rows(text, mesh, "", "", 0, /*counted=*/true);
  return text;
}

std::string encode_obj(const PolygonMesh& mesh) {
  std::string text;
  append_rows(text, mesh, "v ", "f", 1, /*counted=*/false);
  return text;
}

template <typename Real>
void append_points(std::string& bytes, const Points& points) {
  for (Eigen::Index i = 0; i < points.size(); ++i) append_bytes(bytes, static_cast<Real>(points.data()[i]));
}

/// What is not a number is none in float either.
bool is_exact_as_float(const Points& points) {
  const auto lost = [](double x) { return static_cast<double>(static_cast<float>(x)) != x && !std::isnan(x); };
  return !points.unaryExpr(lost).any();
}

std::string encode_ply(const PolygonMesh& mesh) {
  const bool single = is_exact_as_float(mesh.vertices);
  std::string bytes = "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(mesh.vertex_count()) + '\n';
  for (const char* name : {"x", "y", "z"}) bytes.append("property ").append(single ? "float " : "double ").append(name).append("\n");
  bytes += ply_face_header(mesh);
  bytes.reserve(bytes.size() + static_cast<std::size_t>(mesh.vertices.size()) * (single ? 4 : 8) + ply_faces_size(mesh));
  single ? append_points<float>(bytes, mesh.vertices) : append_points<double>(bytes, mesh.vertices);
  append_ply_faces(bytes, mesh);
  return bytes;
}

/// A triangle's unit normal and its corners, as rows; the normal is zero where the triangle has no area.
Eigen::Matrix<double, 4, 3> facet(const Points& vertices, const std::uint32_t* corners) {
  Eigen::Matrix<double, 4, 3> rows;
  for (int k = 0; k < 3; ++k) rows.row(k + 1) = vertices.row(corners[k]);
  const Eigen::RowVector3d normal = (rows.row(2) - rows.row(1)).stableNormalized().cross((rows.row(3) - rows.row(1)).stableNormalized());
  const double length = normal.norm();
  rows.row(0) = length > 0 ? Eigen::RowVector3d(normal / length) : Eigen::RowVector3d::Zero();
  return rows;
}

std::string encode_binary_stl(const PolygonMesh& mesh, const std::vector<std::uint32_t>& triangles) {
  constexpr std::size_t title_length = 80;
  constexpr std::size_t facet_length = 50;
  std::string bytes = "written by spherematch";  // a title that starts with "solid" would look like text
  bytes.resize(title_length, ' ');
  bytes.reserve(title_length + 4 + triangles.size() / 3 * facet_length);
  append_bytes(bytes, static_cast<std::uint32_t>(triangles.size() / 3));
  for (std::size_t i = 0; i < triangles.size(); i += 3) {
    const Eigen::Matrix<float, 4, 3, Eigen::RowMajor> rows = facet(mesh.vertices, &triangles[i]).cast<float>();
    for (Eigen::Index k = 0; k < rows.size(); ++k) append_bytes(bytes, rows.data()[k]);
    append_bytes(bytes, std::uint16_t{0});
  }
  return bytes;
}

std::string encode_text_stl(const PolygonMesh& mesh, const std::vector<std::uint32_t>& triangles) {
  std::string text = "solid spherematch\n";
  const auto append_row = [&text](const char* word, const auto& row) {
    text += word;
    for (int k = 0; k < 3; ++k) append_text(text += ' ', row(k));
    text += '\n';
  };
  for (std::size_t i = 0; i < triangles.size(); i += 3) {
    const Eigen::Matrix<double, 4, 3> rows = facet(mesh.vertices, &triangles[i]);
    append_row("facet normal", rows.row(0));
    text += "outer loop\n";
    for (int k = 1; k < 4; ++k) append_row("vertex", rows.row(k));
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid spherematch\n";
}

std::string encode_stl(const PolygonMesh& mesh) {
  const std::vector<std::uint32_t> triangles = fan_triangles(mesh, mesh.vertices);
  return fits_float(box_of(mesh.vertices)) ? encode_binary_stl(mesh, triangles) : encode_text_stl(mesh, triangles);
}

std::string encode_glb(const PolygonMesh& mesh) {
  GlbFile file;
  file.add(mesh, nullptr, {});
  return file.bytes();
}

}  // namespace

std::optional<MeshFormat> mesh_format_named(std::string_view name) {
  for (const auto& [known, format] : formats) {
    if (known == name) return format;
  }
  return std::nullopt;
}

std::string encode_mesh(MeshFormat format, const PolygonMesh& mesh) {
  switch (format) {
    case MeshFormat::off:
      return encode_off(mesh);
    case MeshFormat::obj:
      return encode_obj(mesh);
    case MeshFormat::ply:
      return encode_ply(mesh);
    case MeshFormat::stl:
      return encode_stl(mesh);
    case MeshFormat::glb:
      return encode_glb(mesh);
  }
  return {};
}

}  // namespace spherematch
