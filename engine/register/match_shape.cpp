#include "engine/register/match_shape.h"

#include <algorithm>
#include <utility>

#include "engine/data/error.h"
#include "engine/register/mirror.h"
#include "engine/spectrum/signatures.h"

namespace spherematch {
namespace {

Grid grid_of(const SignalGrid& signal, bool mirrored) {
  return (mirrored ? mirrored_grid(signal.values) : signal.values).cast<double>().array();
}

std::vector<Grid> grids_of(const PreprocessedShape& shape, bool mirrored) {
  if (shape.signals.empty()) throw EngineError(ErrorCode::invalid_parameter, "the shape has no signals");
  std::vector<Grid> grids;
  for (const SignalGrid& signal : shape.signals) grids.push_back(grid_of(signal, mirrored));
  return grids;
}

}  // namespace

MatchShape::MatchShape(std::shared_ptr<const PreprocessedShape> shape, bool mirrored)
    : shape_(std::move(shape)),
      mirrored_(mirrored),
      signals_(grids_of(*shape_, mirrored)),
      sphere_(spread_over(surface(), working_sphere())),
      faces_(mirrored ? mirrored_faces(surface().mesh.faces) : surface().mesh.faces),
      repair_(surface().mesh.vertices, faces_),
      location_(sphere_, faces_) {}

Eigen::Index MatchShape::channel(const std::string& name) const {
  const auto& signals = shape_->signals;
  const auto found = std::find_if(signals.begin(), signals.end(), [&name](const SignalGrid& s) { return s.name == name; });
  if (found == signals.end())
    throw EngineError(ErrorCode::invalid_parameter, "the shape has no signal " + name + "; a time must be one at which signals are stored");
  return found - signals.begin();
}

std::vector<Eigen::Index> MatchShape::eigenfunctions() const {
  std::vector<Eigen::Index> channels;
  for (std::size_t i = 0; i < shape_->signals.size(); ++i)
    if (shape_->signals[i].name.starts_with(eigenfunction_prefix)) channels.push_back(static_cast<Eigen::Index>(i));
  return channels;
}

Grid MatchShape::signal(const std::string& name) const {
  return grid_of(shape_->signals[static_cast<std::size_t>(channel(name))], mirrored_);
}

Points MatchShape::working_sphere() const { return mirrored_ ? mirrored_points(shape_->sphere) : shape_->sphere; }

Triangles MatchShape::working_faces() const {
  const Triangles& faces = surface().working_mesh().faces;
  return mirrored_ ? mirrored_faces(faces) : faces;
}

std::size_t MatchShape::index_bytes() const {
  const auto bytes = [](const auto& matrix) {
    return static_cast<std::size_t>(matrix.size()) * sizeof(typename std::decay_t<decltype(matrix)>::Scalar);
  };
  return sizeof(*this) + signals_.bytes() + bytes(sphere_) + bytes(faces_) + repair_.bytes() + location_.bytes();
}

}  // namespace spherematch
