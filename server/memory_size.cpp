#include "server/memory_size.h"

namespace spherematch {

namespace {

template <typename Matrix>
std::size_t bytes_of(const Matrix& matrix) {
  return static_cast<std::size_t>(matrix.size()) * sizeof(typename Matrix::Scalar);
}

std::size_t bytes_of(const Correspondence& map) {
  return map.vertex.size() * sizeof(map.vertex[0]) + bytes_of(map.corners) + bytes_of(map.bary);
}

}  // namespace

std::size_t memory_size(const PreprocessedShape& shape) {
  const Surface& surface = shape.surface;
  std::size_t bytes = sizeof(PreprocessedShape) + bytes_of(surface.mesh.vertices) + bytes_of(surface.mesh.faces) +
                      bytes_of(surface.uploaded_corners) + surface.surface_vertex.size() * sizeof(surface.surface_vertex[0]) +
                      bytes_of(shape.sphere) + bytes_of(shape.eigenvalues) + bytes_of(shape.eigenvectors);
  if (surface.decimated) {
    bytes += bytes_of(surface.decimated->mesh.vertices) + bytes_of(surface.decimated->mesh.faces) +
             surface.decimated->places.size() * sizeof(SurfacePoint);
  }
  for (const SignalGrid& signal : shape.signals) bytes += bytes_of(signal.values);
  return bytes;
}

std::size_t memory_size(const MatchResult& result) {
  return sizeof(MatchResult) + bytes_of(result.map) + bytes_of(result.reverse) + result.candidates.size() * sizeof(CandidateSummary);
}

}  // namespace spherematch
