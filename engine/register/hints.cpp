#include "engine/register/hints.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "engine/data/error.h"
#include "engine/mesh/laplacian.h"
#include "engine/sphere/advection.h"

namespace spherematch {
namespace {

VertexMean place(const Surface& surface, std::int32_t vertex, const char* side) {
  const auto refuse = [&](const std::string& why) {
    throw EngineError(ErrorCode::invalid_parameter, "hints: vertex " + std::to_string(vertex) + " of the " + side + " " + why);
  };
  if (vertex < 0 || vertex >= surface.uploaded_vertices())
    refuse("does not exist; it has " + std::to_string(surface.uploaded_vertices()) + " vertices, numbered from 0");
  const std::int32_t place = surface.surface_vertex[static_cast<std::size_t>(vertex)];
  if (place < 0) refuse("was dropped when the mesh was repaired");
  if (!surface.decimated) return {{place, place, place}, {1, 0, 0}};
  const auto& [face, weights] = surface.decimated->places[static_cast<std::size_t>(place)];
  const auto corners = surface.decimated->mesh.faces.row(face);
  return {{corners[0], corners[1], corners[2]}, {weights[0], weights[1], weights[2]}};
}

double angle_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

/// A smooth tangent field: a sum of bumps around a few centres.
class BumpField {
 public:
  /// Takes the values `displacements` (H, 3) at the unit vectors `centers` (H, 3), the nearer the greater the weight (H) is. `width` is
  /// that of a bump, in radians.
  BumpField(Points centers, const Points& displacements, const Eigen::VectorXd& weights, double width)
      : centers_(std::move(centers)), sharpness_(1 / (width * width)) {
    Eigen::MatrixXd system = (centers_ * centers_.transpose()).unaryExpr([this](double cosine) { return bump(cosine); });
    system.diagonal() += kSlack * weights.cwiseInverse();
    amplitudes_ = system.llt().solve(displacements);
  }

  [[nodiscard]] TangentField on_grid() const {
    constexpr int kResolution = 128;
    TangentGrid grid{Grid(kResolution, kResolution), Grid(kResolution, kResolution)};
    for (int j = 0; j < kResolution; ++j)
      for (int i = 0; i < kResolution; ++i) {
        const double colatitude = std::numbers::pi * (j + 0.5) / kResolution, longitude = 2 * std::numbers::pi * (i + 0.5) / kResolution;
        const Eigen::Vector3d value = at(sphere_point(colatitude, longitude));
        grid.colatitude(j, i) = value.dot(sphere_point(colatitude + 0.5 * std::numbers::pi, longitude));
        grid.longitude(j, i) = value.dot(Eigen::Vector3d(-std::sin(longitude), std::cos(longitude), 0));
      }
    return TangentField(grid);
  }

 private:
  static constexpr double kSlack = 0.05;  ///< against overshooting between hints that contradict each other

  [[nodiscard]] Eigen::Vector3d at(const Eigen::Vector3d& p) const {
    Eigen::Vector3d value = Eigen::Vector3d::Zero();
    for (Eigen::Index i = 0; i < centers_.rows(); ++i) value += bump(centers_.row(i).dot(p)) * amplitudes_.row(i).transpose();
    return value;
  }
  [[nodiscard]] double bump(double cosine) const { return std::exp((cosine - 1) * sharpness_); }

  Points centers_;
  double sharpness_;
  Points amplitudes_;
};

}  // namespace

std::vector<PlacedHint> place_hints(const Surface& source, const Surface& target, const std::vector<Hint>& hints) {
  std::vector<PlacedHint> placed;
  for (const Hint& hint : hints) placed.push_back({place(source, hint.source, "source"), place(target, hint.target, "target")});
  return placed;
}

HintDirections directions(const std::vector<PlacedHint>& hints, const Points& source_sphere, const Points& target_sphere) {
  const auto count = static_cast<Eigen::Index>(hints.size());
  HintDirections result{Points(count, 3), Points(count, 3)};
  for (Eigen::Index i = 0; i < count; ++i) {
    const PlacedHint& hint = hints[static_cast<std::size_t>(i)];
    result.source.row(i) = hint.source.of(source_sphere).normalized();
    result.target.row(i) = hint.target.of(target_sphere).normalized();
  }
  return result;
}

std::optional<Eigen::Matrix3d> rotation_from_hints(const HintDirections& hints) {
  constexpr int kIterations = 30;
  constexpr double kSmallAngle = 0.1;  // below it the weight does not grow any more
  constexpr double kDetermined = 0.1;  // of the second singular value against the first
  const Points &from = hints.source, &to = hints.target;
  Eigen::VectorXd weights = Eigen::VectorXd::Ones(from.rows());
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    const Eigen::Matrix3d covariance = to.transpose() * weights.asDiagonal() * from;
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(covariance, Eigen::ComputeFullU | Eigen::ComputeFullV);
    const double handedness = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0 ? -1 : 1;
    const Eigen::Vector3d& values = svd.singularValues();
    if (!(values[1] + handedness * values[2] > kDetermined * values[0])) return std::nullopt;
    rotation = svd.matrixU() * Eigen::Vector3d(1, 1, handedness).asDiagonal() * svd.matrixV().transpose();
    for (Eigen::Index i = 0; i < weights.size(); ++i)
      weights[i] = 1 / std::max(angle_between(rotation * from.row(i).transpose(), to.row(i)), kSmallAngle);
  }
  return rotation;
}

void pull_together(FlowSide& source, FlowSide& target, const HintDirections& hints, double width) {
  constexpr int kSteps = 8;
  constexpr double kFar = 0.8;  // radians; beyond it a hint pulls less and less
  for (int step = 0; step < kSteps; ++step) {
    const Points from = source.warp().forward(hints.source), to = target.warp().forward(hints.target);
    Points centers(from.rows(), 3), displacements(from.rows(), 3);
    Eigen::VectorXd weights(from.rows());
    Eigen::Index used = 0;
    for (Eigen::Index i = 0; i < from.rows(); ++i) {
      const double angle = angle_between(from.row(i), to.row(i));
      if (!(angle < 0.5 * std::numbers::pi)) continue;
      const Eigen::Vector3d chord = (to.row(i) - from.row(i)).transpose();
      const double size = chord.norm();
      centers.row(used) = (from.row(i) + to.row(i)).normalized();
      displacements.row(used) = (size > 0 ? angle / size : 0) * chord / (kSteps - step);
      weights[used] = 1 / (1 + std::pow(angle / kFar, 4));
      ++used;
    }
    if (used == 0) return;
    const BumpField field(centers.topRows(used), displacements.topRows(used), weights.head(used), width);
    const auto on_grid = std::make_shared<const TangentField>(field.on_grid());
    source.move(on_grid, 0.5);
    target.move(on_grid, -0.5);
  }
}

}  // namespace spherematch
