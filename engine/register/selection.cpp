#include "engine/register/selection.h"

#include <cmath>

#include "engine/spectrum/signatures.h"
#include "engine/sphere/harmonics.h"
#include "engine/sphere/rasterizer.h"

namespace spherematch {

Eigen::MatrixXd selection_signals(const PreprocessedShape& shape) {
  constexpr int kEnergies = 16;
  const Eigen::MatrixXd heat = heat_kernel_signatures(shape.eigenvalues, shape.eigenvectors, {0.003, 0.001}).array().max(1e-12).log();
  const Eigen::MatrixXd wave = wave_kernel_signatures(shape.eigenvalues, shape.eigenvectors, kEnergies).rightCols(kEnergies / 2);
  // Logarithms compare relative differences. The two heat signals and all wave energies together weigh alike.
  Eigen::MatrixXd signals(heat.rows(), heat.cols() + wave.cols());
  signals << heat, wave.array().max(1e-12).log().matrix() * (1.0 / static_cast<double>(wave.cols()));
  return signals;
}

double registration_cost(const Eigen::MatrixXd& source_signals, const Eigen::VectorXd& vertex_weights,
                         const Eigen::MatrixXd& target_signals, const Triangles& target_faces, const std::vector<Location>& locations) {
  double cost = 0;
  for (Eigen::Index v = 0; v < source_signals.rows(); ++v) {
    const Location& at = locations[static_cast<std::size_t>(v)];
    const auto image = at.bary[0] * target_signals.row(target_faces(at.face, 0)) +
                       at.bary[1] * target_signals.row(target_faces(at.face, 1)) +
                       at.bary[2] * target_signals.row(target_faces(at.face, 2));
    cost += vertex_weights[v] * (source_signals.row(v) - image).cwiseAbs().mean();
  }
  return cost;
}

double paper_cost(const Points& source_sphere, const Triangles& source_faces, const Eigen::VectorXd& source_signal,
                  const Points& target_sphere, const Triangles& target_faces, const Eigen::VectorXd& target_signal, int resolution) {
  const int degree = resolution / 2 - 1;
  const double bandwidth = 0.5 * resolution, time = std::log(100.0) / (bandwidth * (bandwidth + 1));
  const HarmonicTransform transform(resolution, degree);
  const auto smoothed = [&](const Points& sphere, const Triangles& faces, const Eigen::VectorXd& signal) {
    Harmonics a = transform.analyze(rasterize_signals(sphere, faces, signal, resolution).front());
    scale_degrees(degree, a, [time](int l) { return std::exp(-time * l * (l + 1)); });
    return transform.synthesize(a);
  };
  const Grid difference = smoothed(source_sphere, source_faces, source_signal) - smoothed(target_sphere, target_faces, target_signal);
  const Eigen::ArrayXd areas = cell_areas(resolution).array();
  return (difference.abs().colwise() * areas).sum() / (areas.sum() * resolution);
}

}  // namespace spherematch
