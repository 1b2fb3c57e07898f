#include "engine/evaluate/vertex_quality.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <optional>

#include "engine/evaluate/surface_distance.h"
#include "engine/register/strain.h"
#include "engine/spectrum/signatures.h"

namespace spherematch {
namespace {

constexpr double kMostDistortion = 3;  ///< twentyfold: of faces without extent, or with an image without

using Images = std::vector<std::optional<PlacedPoint>>;

/// The mean square of the logarithms of the singular values.
double squared_distortion(const FlatTriangle& face, const TriangleCorners& image) {
  const Strain s = strain(
      face, {image, {Eigen::Matrix<double, 3, 2>::Zero(), Eigen::Matrix<double, 3, 2>::Zero(), Eigen::Matrix<double, 3, 2>::Zero()}});
  const double square = s.area > 0 ? s.values.head<2>().squaredNorm() / 4 : kMostDistortion * kMostDistortion;
  return std::isfinite(square) ? std::min(square, kMostDistortion * kMostDistortion) : kMostDistortion * kMostDistortion;
}

struct Distortions {
  Eigen::VectorXd at_vertices;  ///< uploaded
  double whole = 0;
};

Distortions distortions_of(const Images& images, const Surface& source, const Surface& target) {
  const double source_unit = unit_length(source), target_unit = unit_length(target);
  const auto count = static_cast<Eigen::Index>(images.size());
  Eigen::VectorXd areas = Eigen::VectorXd::Zero(count), squares = areas;
  for (Eigen::Index f = 0; f < source.mesh.face_count(); ++f) {
    TriangleCorners corners, places;
    bool complete = true;
    for (int k = 0; k < 3 && complete; ++k) {
      const std::int32_t uploaded = source.uploaded_corners(f, k);
      complete = uploaded >= 0 && images[static_cast<std::size_t>(uploaded)];
      if (!complete) break;
      corners[static_cast<std::size_t>(k)] = source.mesh.vertices.row(source.mesh.faces(f, k)) / source_unit;
      places[static_cast<std::size_t>(k)] = images[static_cast<std::size_t>(uploaded)]->position.transpose() / target_unit;
    }
    if (!complete) continue;
    const FlatTriangle face(corners);
    if (!(face.area > 0)) continue;
    const double square = squared_distortion(face, places);
    for (int k = 0; k < 3; ++k) {
      areas[source.uploaded_corners(f, k)] += face.area;
      squares[source.uploaded_corners(f, k)] += face.area * square;
    }
  }
  Distortions result;
  if (areas.sum() > 0) result.whole = std::sqrt(squares.sum() / areas.sum());
  result.at_vertices = (areas.array() > 0).select((squares.array() / areas.array()).sqrt(), 0.0);
  return result;
}

/// The signals that tell places apart (selection_signals()), at points of the sphere.
Eigen::MatrixXd signals_at(const MatchShape& shape, const Points& places) {
  const std::vector<std::string> names = selection_signal_names();
  std::vector<Eigen::Index> channels;
  channels.reserve(names.size());
  for (const std::string& name : names) channels.push_back(shape.channel(name));
  Eigen::MatrixXd values(places.rows(), static_cast<Eigen::Index>(channels.size()));
  shape.signals().for_each_stencil(places, [&](Eigen::Index i, const GridSamples::Stencil& stencil) {
    shape.signals().for_each_value(stencil, channels, [&](std::size_t c, float value) { values(i, static_cast<Eigen::Index>(c)) = value; });
  });
  return values;
}

/// The vertices and their images on the prepared spheres; any point where a vertex was dropped.
struct Directions {
  Points vertices, images;
};

Directions directions_of(const Images& images, const MatchShape& source, const MatchShape& target) {
  const auto count = static_cast<Eigen::Index>(images.size());
  Directions directions{Points::Zero(count, 3), Points::Zero(count, 3)};
  directions.vertices.col(0).setOnes();
  directions.images.col(0).setOnes();
  const Points uploaded = uploaded_sphere(source.shape());
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto& image = images[static_cast<std::size_t>(i)];
    if (!image || !uploaded.row(i).allFinite()) continue;
    Eigen::RowVector3d place = Eigen::RowVector3d::Zero();
    for (std::size_t k = 0; k < 3; ++k) place += image->weights[k] * target.sphere().row(image->corners[k]);
    directions.vertices.row(i) = uploaded.row(i);
    if (place.norm() > 0) directions.images.row(i) = place.normalized();
  }
  return directions;
}

/// Logistic regression on the logarithms of the features, from 24,600 points of 82 maps (docs/method.md).
Eigen::ArrayXd probability(const Eigen::ArrayXd& distortion, const Eigen::ArrayXd& difference, double whole) {
  constexpr double kConstant = -1.909, kDistortion = -0.337, kDifference = -0.340, kWhole = -3.315;
  constexpr double kFloor = 0.01;  // of each, where logarithms would say nothing any more
  const Eigen::ArrayXd score =
      kConstant + kDistortion * (distortion + kFloor).log() + kDifference * (difference + kFloor).log() + kWhole * std::log(whole + kFloor);
  return 1 / (1 + (-score).exp());
}

std::vector<float> to_floats(const Eigen::ArrayXd& values) {
  const Eigen::ArrayXf floats = values.cast<float>();
  return {floats.data(), floats.data() + floats.size()};
}

}  // namespace

VertexQuality vertex_quality(const MatchShape& source, const MatchShape& target, const Correspondence& map) {
  require_rows(map, source.surface());
  const Images images = images_of(map, target.surface());
  const Distortions distortions = distortions_of(images, source.surface(), target.surface());
  const Directions directions = directions_of(images, source, target);
  const std::vector<double> given = selection_signal_weights();
  const Eigen::VectorXd weights = Eigen::Map<const Eigen::VectorXd>(given.data(), static_cast<Eigen::Index>(given.size()));
  const Eigen::MatrixXd differences = signals_at(source, directions.vertices) - signals_at(target, directions.images);
  const Eigen::ArrayXd difference = (differences.cwiseAbs2() * weights).cwiseSqrt();
  Eigen::ArrayXd confidence = probability(distortions.at_vertices, difference, distortions.whole);
  for (std::size_t i = 0; i < images.size(); ++i)
    if (!images[i]) confidence[static_cast<Eigen::Index>(i)] = 0;
  return {to_floats(distortions.at_vertices), to_floats(confidence)};
}

}  // namespace spherematch
