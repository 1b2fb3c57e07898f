#include "engine/register/flow_side.h"

#include <utility>

#include "engine/spectrum/signatures.h"
#include "engine/sphere/rasterizer.h"

namespace spherematch {
namespace {

/// The map of nodes to `origins`, between the nodes.
class OriginSamples {
 public:
  OriginSamples(const Points& origins, int n) : samples_(coordinates(origins, n)) {}

  [[nodiscard]] Points at(const Points& points) const {
    Points result(points.rows(), 3);
    samples_.for_each_stencil(points, [&](Eigen::Index i, const GridSamples::Stencil& stencil) {
      result.row(i) = samples_(stencil, 0).head<3>().cast<double>().matrix().normalized();
    });
    return result;
  }

 private:
  static std::vector<Grid> coordinates(const Points& origins, int n) {
    std::vector<Grid> grids;
    for (int k = 0; k < 3; ++k)
      grids.emplace_back(Eigen::Map<const Grid, 0, Eigen::Stride<Eigen::Dynamic, 3>>(origins.data() + k, n, n, {3 * n, 3}));
    return grids;
  }

  GridSamples samples_;
};

}  // namespace

GridFlowSide::GridFlowSide(const GridSamples& samples, const std::vector<Eigen::Index>& channels, const Eigen::Matrix3d& rotation,
                           int resolution)
    : FlowSide(rotation), samples_(samples), channels_(channels), resolution_(resolution), origins_(cell_centers(resolution) * rotation) {}

std::vector<Harmonics> GridFlowSide::signals(const std::vector<std::size_t>& channels, const HarmonicTransform&,
                                             const HarmonicTransform& on_nodes) const {
  std::vector<Eigen::Index> read;
  for (const std::size_t c : channels) read.push_back(channels_[c]);
  std::vector<Grid> grids(channels.size(), Grid(resolution_, resolution_));
  samples_.for_each_stencil(origins_, [&](Eigen::Index node, const GridSamples::Stencil& stencil) {
    samples_.for_each_value(stencil, read, [&](std::size_t c, float value) { grids[c].data()[node] = value; });
  });
  std::vector<Harmonics> result;
  for (const Grid& grid : grids) result.push_back(on_nodes.analyze(grid));
  return result;
}

Points GridFlowSide::origins(int resolution) const {
  if (resolution == resolution_) return origins_;
  return OriginSamples(origins_, resolution_).at(cell_centers(resolution));
}

Points GridFlowSide::origins(const Points& points) const { return OriginSamples(origins_, resolution_).at(points); }

void GridFlowSide::move(const std::shared_ptr<const TangentField>& field, double step) {
  warp_.append(field, step);
  Points before = cell_centers(resolution_);
  advect(before, *field, -step);
  origins_ = OriginSamples(origins_, resolution_).at(before);
}

void GridFlowSide::follow(int resolution) {
  origins_ = origins(resolution);
  resolution_ = resolution;
}

MeshSignals::MeshSignals(const MatchShape& shape, const std::vector<double>& times)
    : sphere(shape.working_sphere()), faces(shape.working_faces()) {
  const Eigen::VectorXd& values = shape.shape().eigenvalues;
  const Eigen::MatrixXf& vectors = shape.shape().eigenvectors;
  const Eigen::MatrixXd heat = heat_kernel_signatures(values, vectors, times), detail = selection_signals(values, vectors);
  signals.resize(heat.rows(), heat.cols() + detail.cols());
  signals << heat, detail;
}

MeshFlowSide::MeshFlowSide(std::shared_ptr<const MeshSignals> mesh, const Eigen::Matrix3d& rotation)
    : FlowSide(rotation), mesh_(std::move(mesh)), sphere_(mesh_->sphere * rotation.transpose()) {}

std::vector<Harmonics> MeshFlowSide::signals(const std::vector<std::size_t>& channels, const HarmonicTransform& on_level,
                                             const HarmonicTransform&) const {
  Eigen::MatrixXd values(sphere_.rows(), static_cast<Eigen::Index>(channels.size()));
  for (std::size_t c = 0; c < channels.size(); ++c)
    values.col(static_cast<Eigen::Index>(c)) = mesh_->signals.col(static_cast<Eigen::Index>(channels[c]));
  std::vector<Harmonics> result;
  for (const Grid& grid : rasterize_signals(sphere_, mesh_->faces, values, on_level.resolution())) result.push_back(on_level.analyze(grid));
  return result;
}

void MeshFlowSide::follow(int) {}  // each call rasterises at the resolution it needs

Points MeshFlowSide::origins(int resolution) const { return warp_.backward(cell_centers(resolution)); }

void MeshFlowSide::move(const std::shared_ptr<const TangentField>& field, double step) {
  warp_.append(field, step);
  advect(sphere_, *field, step);
}

}  // namespace spherematch
