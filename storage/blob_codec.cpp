#include "storage/blob_codec.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <string>

#include "storage/blob_frame.h"
#include "storage/byte_stream.h"
#include "storage/error.h"

namespace spherematch {
namespace {

[[noreturn]] void corrupt(const std::string& what) { throw StorageError(StorageErrorCode::corrupt_blob, what); }

Blob empty_frame(std::size_t payload_size) {
  Blob blob;
  blob.reserve(blob_header_size + payload_size);
  blob.resize(blob_header_size);
  return blob;
}

std::size_t byte_count(Eigen::Index numbers, std::size_t size) { return static_cast<std::size_t>(numbers) * size; }

template <typename Matrix>
void write_matrix(ByteWriter& writer, const Matrix& matrix) {
  writer.array(matrix.data(), static_cast<std::size_t>(matrix.size()));
}

/// A matrix in its own storage order; its size is checked against what is left before it is allocated.
template <typename Matrix>
Matrix read_matrix(ByteReader& reader, std::uint64_t rows, std::uint64_t columns) {
  constexpr std::uint64_t limit = std::numeric_limits<std::uint32_t>::max();
  if (rows > limit || columns > limit) corrupt("a stored array claims an impossible size");
  reader.require<typename Matrix::Scalar>(rows * columns);
  Matrix matrix(static_cast<Eigen::Index>(rows), static_cast<Eigen::Index>(columns));
  reader.array(matrix.data(), static_cast<std::size_t>(rows * columns));
  return matrix;
}

void check_indices(const std::int32_t* indices, std::size_t count, std::int64_t low, std::int64_t end) {
  const bool good = std::all_of(indices, indices + count, [=](std::int32_t index) { return index >= low && index < end; });
  if (!good) corrupt("a stored surface has an index out of range");
}

constexpr std::array report_fields{
    &RepairReport::filled_loops,     &RepairReport::added_vertices,  &RepairReport::added_faces,
    &RepairReport::dropped_vertices, &RepairReport::welded_vertices, &RepairReport::split_vertices,
    &RepairReport::flipped_faces,    &RepairReport::removed_faces,   &RepairReport::dropped_components,
};
/// What a decimated surface has after all else. Other surfaces end before it, as all did in the first releases.
void write_decimated(ByteWriter& writer, const DecimatedMesh& decimated) {
  writer.number(static_cast<std::uint32_t>(decimated.mesh.vertex_count()));
  writer.number(static_cast<std::uint32_t>(decimated.mesh.face_count()));
  writer.number(decimated.seconds);
  write_matrix(writer, decimated.mesh.vertices);
  write_matrix(writer, decimated.mesh.faces);
  for (const SurfacePoint& place : decimated.places) {
    writer.number(place.face);
    writer.array(place.weights.data(), place.weights.size());
  }
}

DecimatedMesh read_decimated(ByteReader& reader, std::uint32_t places) {
  const auto vertices = reader.number<std::uint32_t>();
  const auto faces = reader.number<std::uint32_t>();
  DecimatedMesh decimated;
  decimated.seconds = reader.number<double>();
  decimated.mesh.vertices = read_matrix<Points>(reader, vertices, 3);
  decimated.mesh.faces = read_matrix<Triangles>(reader, faces, 3);
  check_indices(decimated.mesh.faces.data(), std::size_t{faces} * 3, 0, vertices);
  reader.require<double>(std::uint64_t{places} * 3);
  decimated.places.resize(places);
  for (SurfacePoint& place : decimated.places) {
    place.face = reader.number<std::int32_t>();
    reader.array(place.weights.data(), place.weights.size());
    check_indices(&place.face, 1, 0, faces);
  }
  return decimated;
}

static_assert(sizeof(RepairReport) == report_fields.size() * sizeof(std::int32_t), "a new field needs a new codec version");

}  // namespace

Blob encode_upload(BlobView bytes) {
  Blob blob = empty_frame(bytes.size());
  blob.insert(blob.end(), bytes.begin(), bytes.end());
  seal_blob(blob, BlobKind::upload, BlobCompression::where_it_helps);
  return blob;
}

Blob decode_upload(BlobView blob) {
  Blob buffer;
  const BlobView payload = open_blob(blob, BlobKind::upload, buffer);
  if (payload.data() == buffer.data()) return buffer;
  return {payload.begin(), payload.end()};
}

Blob encode_surface(const Surface& surface) {
  const TriMesh& mesh = surface.mesh;
  const std::size_t indices = byte_count(mesh.faces.size() + surface.uploaded_corners.size(), sizeof(std::int32_t));
  Blob blob =
      empty_frame(byte_count(mesh.vertices.size(), sizeof(double)) + indices + surface.surface_vertex.size() * sizeof(std::int32_t) + 64);
  ByteWriter writer(blob);
  writer.number(static_cast<std::uint32_t>(mesh.vertex_count()));
  writer.number(static_cast<std::uint32_t>(mesh.face_count()));
  writer.number(static_cast<std::uint32_t>(surface.surface_vertex.size()));
  writer.number(surface.uploaded_faces);
  for (const auto field : report_fields) writer.number(surface.report.*field);
  write_matrix(writer, mesh.vertices);
  write_matrix(writer, mesh.faces);
  write_matrix(writer, surface.uploaded_corners);
  writer.array(surface.surface_vertex.data(), surface.surface_vertex.size());
  if (surface.decimated) write_decimated(writer, *surface.decimated);
  seal_blob(blob, BlobKind::surface, BlobCompression::where_it_helps);
  return blob;
}

Surface decode_surface(BlobView blob) {
  Blob buffer;
  ByteReader reader(open_blob(blob, BlobKind::surface, buffer));
  const auto vertices = reader.number<std::uint32_t>();
  const auto faces = reader.number<std::uint32_t>();
  const auto uploaded = reader.number<std::uint32_t>();
  Surface surface;
  surface.uploaded_faces = reader.number<std::int32_t>();
  for (const auto field : report_fields) surface.report.*field = reader.number<std::int32_t>();
  surface.mesh.vertices = read_matrix<Points>(reader, vertices, 3);
  surface.mesh.faces = read_matrix<Triangles>(reader, faces, 3);
  surface.uploaded_corners = read_matrix<Triangles>(reader, faces, 3);
  reader.require<std::int32_t>(uploaded);
  surface.surface_vertex.resize(uploaded);
  reader.array(surface.surface_vertex.data(), uploaded);
  if (!reader.at_end()) surface.decimated = read_decimated(reader, vertices);
  reader.finish();
  check_indices(surface.mesh.faces.data(), std::size_t{faces} * 3, 0, vertices);
  check_indices(surface.uploaded_corners.data(), std::size_t{faces} * 3, -1, uploaded);
  check_indices(surface.surface_vertex.data(), uploaded, -1, vertices);
  return surface;
}

Blob encode_sphere(const Points& sphere) {
  Blob blob = empty_frame(byte_count(sphere.size(), sizeof(double)) + sizeof(std::uint32_t));
  ByteWriter writer(blob);
  writer.number(static_cast<std::uint32_t>(sphere.rows()));
  write_matrix(writer, sphere);
  seal_blob(blob, BlobKind::sphere, BlobCompression::none);
  return blob;
}

Points decode_sphere(BlobView blob) {
  Blob buffer;
  ByteReader reader(open_blob(blob, BlobKind::sphere, buffer));
  const auto rows = reader.number<std::uint32_t>();
  Points sphere = read_matrix<Points>(reader, rows, 3);
  reader.finish();
  return sphere;
}

Blob encode_signals(const std::vector<SignalGrid>& signals) {
  Blob blob = empty_frame(0);
  ByteWriter writer(blob);
  writer.number(static_cast<std::uint32_t>(signals.size()));
  for (const SignalGrid& signal : signals) {
    writer.text(signal.name);
    writer.number(static_cast<std::uint32_t>(signal.values.rows()));
    writer.number(static_cast<std::uint32_t>(signal.values.cols()));
    write_matrix(writer, signal.values);
  }
  seal_blob(blob, BlobKind::signals, BlobCompression::none);
  return blob;
}

std::vector<SignalGrid> decode_signals(BlobView blob) {
  Blob buffer;
  ByteReader reader(open_blob(blob, BlobKind::signals, buffer));
  const auto count = reader.number<std::uint32_t>();
  std::vector<SignalGrid> signals;
  // Not reserved: the count is believed only as far as signals follow.
  for (std::uint32_t i = 0; i < count; ++i) {
    std::string name = reader.text();
    const auto rows = reader.number<std::uint32_t>();
    const auto columns = reader.number<std::uint32_t>();
    signals.push_back({std::move(name), read_matrix<Eigen::MatrixXf>(reader, rows, columns)});
  }
  reader.finish();
  return signals;
}

Blob encode_eigenbasis(const Eigen::VectorXd& eigenvalues, const Eigen::MatrixXf& eigenvectors) {
  Blob blob = empty_frame(byte_count(eigenvalues.size(), sizeof(double)) + byte_count(eigenvectors.size(), sizeof(float)) + 12);
  ByteWriter writer(blob);
  writer.number(static_cast<std::uint32_t>(eigenvalues.size()));
  writer.number(static_cast<std::uint32_t>(eigenvectors.rows()));
  writer.number(static_cast<std::uint32_t>(eigenvectors.cols()));
  write_matrix(writer, eigenvalues);
  write_matrix(writer, eigenvectors);
  seal_blob(blob, BlobKind::eigenbasis, BlobCompression::none);
  return blob;
}

StoredEigenbasis decode_eigenbasis(BlobView blob) {
  Blob buffer;
  ByteReader reader(open_blob(blob, BlobKind::eigenbasis, buffer));
  const auto values = reader.number<std::uint32_t>();
  const auto rows = reader.number<std::uint32_t>();
  const auto columns = reader.number<std::uint32_t>();
  StoredEigenbasis basis;
  basis.eigenvalues = read_matrix<Eigen::VectorXd>(reader, values, 1);
  basis.eigenvectors = read_matrix<Eigen::MatrixXf>(reader, rows, columns);
  reader.finish();
  return basis;
}

}  // namespace spherematch
