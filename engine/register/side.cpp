#include "engine/register/side.h"

#include <algorithm>
#include <string>
#include <vector>

#include "engine/data/error.h"
#include "engine/register/mirror.h"
#include "engine/spectrum/signatures.h"

namespace spherematch {
namespace {

Grid stored_grid(const PreprocessedShape& shape, const std::string& name, bool mirrored) {
  const auto signal = std::find_if(shape.signals.begin(), shape.signals.end(), [&name](const SignalGrid& s) { return s.name == name; });
  if (signal == shape.signals.end())
    throw EngineError(ErrorCode::invalid_parameter, "the shape has no signal " + name + "; a time must be one at which signals are stored");
  return (mirrored ? mirrored_grid(signal->values) : signal->values).cast<double>().array();
}

GridSamples heat_samples(const PreprocessedShape& shape, const std::vector<double>& times, bool mirrored) {
  std::vector<Grid> channels;
  for (const double time : times) channels.push_back(stored_grid(shape, hks_name(time), mirrored));
  return GridSamples(channels);
}

GridSamples selection_samples(const PreprocessedShape& shape, const MatchParameters& parameters, bool mirrored) {
  if (parameters.paper_selection) return heat_samples(shape, {0.01}, mirrored);
  std::vector<Grid> channels;
  for (const std::string& name : selection_signal_names()) channels.push_back(stored_grid(shape, name, mirrored));
  return GridSamples(channels);
}

}  // namespace

Side::Side(const PreprocessedShape& shape, const MatchParameters& parameters, bool as_mirror_image)
    : mirrored(as_mirror_image),
      rotation(stored_grid(shape, hks_name(parameters.rotation_time), mirrored)),
      flow(heat_samples(shape, parameters.flow_times, mirrored)),
      selection(selection_samples(shape, parameters, mirrored)),
      sphere(mirrored ? mirrored_points(shape.sphere) : shape.sphere),
      faces(mirrored ? mirrored_faces(shape.surface.working_mesh().faces) : shape.surface.working_mesh().faces) {
  if (parameters.mesh_flow) vertex_signals = heat_kernel_signatures(shape.eigenvalues, shape.eigenvectors, parameters.flow_times);
}

}  // namespace spherematch
