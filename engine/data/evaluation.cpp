#include "engine/data/evaluation.h"

#include <string>

#include "engine/data/error.h"

namespace spherematch {

std::vector<double> curve_thresholds() {
  std::vector<double> thresholds;
  for (int step = 0; step <= curve_steps; ++step) thresholds.push_back(curve_end * step / curve_steps);
  return thresholds;
}

GroundTruth identity_truth(std::int32_t source_vertices, std::int32_t target_vertices) {
  if (source_vertices != target_vertices) {
    throw EngineError(ErrorCode::invalid_parameter, "the meshes have " + std::to_string(source_vertices) + " and " +
                                                        std::to_string(target_vertices) + " vertices, so the truth is not the identity");
  }
  GroundTruth truth{.direct = {}, .mirrored = {}, .dense = true};
  for (std::int32_t v = 0; v < source_vertices; ++v) truth.direct.push_back({v, v});
  return truth;
}

GroundTruth index_truth(const std::vector<std::int32_t>& targets) {
  GroundTruth truth{.direct = {}, .mirrored = {}, .dense = true};
  for (std::size_t i = 0; i < targets.size(); ++i) {
    if (targets[i] != -1) truth.direct.push_back({static_cast<std::int32_t>(i), targets[i]});
  }
  return truth;
}

std::vector<Landmark> paired(const std::vector<std::int32_t>& sources, const std::vector<std::int32_t>& targets) {
  if (sources.size() != targets.size()) {
    throw EngineError(ErrorCode::invalid_parameter,
                      "the landmark lists have " + std::to_string(sources.size()) + " and " + std::to_string(targets.size()) + " entries");
  }
  std::vector<Landmark> landmarks;
  for (std::size_t i = 0; i < sources.size(); ++i) landmarks.push_back({sources[i], targets[i]});
  return landmarks;
}

}  // namespace spherematch
