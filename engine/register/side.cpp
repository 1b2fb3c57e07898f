#include "engine/register/side.h"

#include <algorithm>
#include <string>

#include "engine/data/error.h"
#include "engine/mesh/laplacian.h"
#include "engine/register/mirror.h"
#include "engine/register/selection.h"
#include "engine/spectrum/signatures.h"

namespace spherematch {

SideSignals::SideSignals(const PreprocessedShape& shape, const MatchParameters& parameters)
    : flow(heat_kernel_signatures(shape.eigenvalues, shape.eigenvectors, parameters.flow_times)),
      selection(parameters.paper_selection ? heat_kernel_signatures(shape.eigenvalues, shape.eigenvectors, {0.01})
                                           : selection_signals(shape)),
      weights(vertex_areas(shape.surface.working_mesh().vertices, shape.surface.working_mesh().faces)) {
  weights /= weights.sum();
}

Side::Side(const PreprocessedShape& shape, const SideSignals& shape_signals, bool as_mirror_image)
    : mirrored(as_mirror_image),
      signals(shape_signals),
      mesh{shape.surface.working_mesh().vertices,
           mirrored ? mirrored_faces(shape.surface.working_mesh().faces) : shape.surface.working_mesh().faces},
      sphere(mirrored ? mirrored_points(shape.sphere) : shape.sphere),
      repair(mesh) {}

Eigen::MatrixXf rotation_grid(const PreprocessedShape& shape, const MatchParameters& parameters, bool mirrored) {
  const std::string name = hks_name(parameters.rotation_time);
  const auto signal = std::find_if(shape.signals.begin(), shape.signals.end(), [&name](const SignalGrid& s) { return s.name == name; });
  if (signal == shape.signals.end())
    throw EngineError(ErrorCode::invalid_parameter, "rotation_time must be one of the times at which the shape's signals are stored");
  return mirrored ? mirrored_grid(signal->values) : signal->values;
}

}  // namespace spherematch
