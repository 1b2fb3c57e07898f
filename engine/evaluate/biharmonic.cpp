#include "engine/evaluate/biharmonic.h"

#include <cmath>

namespace spherematch {

namespace {

/// Values at the vertices of surface.mesh of a function that is known at those of the working mesh.
Eigen::VectorXf at_surface_vertices(const Surface& surface, const Eigen::VectorXf& values) {
  if (!surface.decimated) return values;
  const auto& [mesh, places, seconds] = *surface.decimated;
  Eigen::VectorXf result(static_cast<Eigen::Index>(places.size()));
  for (std::size_t v = 0; v < places.size(); ++v) {
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      sum += places[v].weights[k] * static_cast<double>(values[mesh.faces(places[v].face, static_cast<Eigen::Index>(k))]);
    }
    result[static_cast<Eigen::Index>(v)] = static_cast<float>(sum);
  }
  return result;
}

double value_at(const PlacedPoint& point, const Eigen::VectorXf& values) {
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) sum += point.weights[k] * static_cast<double>(values[point.corners[k]]);
  return sum;
}

}  // namespace

std::vector<double> biharmonic_distances(const PreprocessedShape& shape, std::span<const PlacedPoint> from, std::span<const PlacedPoint> to,
                                         const Progress& progress) {
  std::vector<double> result(from.size(), 0.0);
  // One eigenvector after the other stays in the processor's cache while all points read it.
  for (Eigen::Index i = 1; i < shape.eigenvalues.size(); ++i) {
    progress.check();
    const Eigen::VectorXf values = at_surface_vertices(shape.surface, shape.eigenvectors.col(i));
    const double weight = 1 / (shape.eigenvalues[i] * shape.eigenvalues[i]);
    for (std::size_t p = 0; p < result.size(); ++p) {
      const double difference = value_at(from[p], values) - value_at(to[p], values);
      result[p] += weight * difference * difference;
    }
  }
  for (double& distance : result) distance = std::sqrt(distance);
  return result;
}

}  // namespace spherematch
