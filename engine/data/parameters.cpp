#include "engine/data/parameters.h"

#include <cmath>
#include <string>

#include "engine/data/error.h"

namespace spherematch {
namespace {

void require(bool holds, const char* field, const char* reason) {
  if (!holds) throw EngineError(ErrorCode::invalid_parameter, std::string(field) + " " + reason);
}

bool positive(double x) { return std::isfinite(x) && x > 0; }

}  // namespace

void PreprocessParameters::validate() const {
  require(conformal_steps >= 1 && conformal_steps <= 1000, "conformal_steps", "must be 1 to 1000");
  require(positive(conformal_step_size), "conformal_step_size", "must be positive");
  require(collapse_passes >= 0 && collapse_passes <= 10, "collapse_passes", "must be 0 to 10");
  require(collapse_steps >= 1 && collapse_steps <= 1000, "collapse_steps", "must be 1 to 1000");
  require(positive(collapse_threshold) && collapse_threshold <= 1, "collapse_threshold", "must be above 0 and at most 1");
  require(authalic_resolution >= 16 && authalic_resolution <= 1024 && authalic_resolution % 2 == 0, "authalic_resolution",
          "must be even, 16 to 1024");
  require(authalic_steps >= 0 && authalic_steps <= 1000, "authalic_steps", "must be 0 to 1000");
  require(positive(authalic_step_size), "authalic_step_size", "must be positive");
  require(positive(authalic_smoothing), "authalic_smoothing", "must be positive");
  require(eigenpairs >= 10 && eigenpairs <= 500, "eigenpairs", "must be 10 to 500");
  require(!hks_times.empty() && hks_times.size() <= 32, "hks_times", "must hold 1 to 32 times");
  for (const double t : hks_times) require(positive(t), "hks_times", "must be positive");
  require(signal_resolution >= 16 && signal_resolution <= 512 && signal_resolution % 2 == 0, "signal_resolution",
          "must be even, 16 to 512");
}

PreprocessParameters PreprocessParameters::paper() {
  PreprocessParameters parameters;
  parameters.collapse_passes = 0;
  parameters.authalic_steps = 100;
  parameters.authalic_step_size = 0.005;
  parameters.single_vector_lanczos = true;
  return parameters;
}

void MatchParameters::validate() const {
  require(positive(rotation_time), "rotation_time", "must be positive");
  require(rotation_bandwidth >= 4 && rotation_bandwidth <= 64, "rotation_bandwidth", "must be 4 to 64");
  require(max_candidates >= 1 && max_candidates <= 16, "max_candidates", "must be 1 to 16");
  require(candidate_separation >= 0 && candidate_separation < 8, "candidate_separation", "must be at least 0 and below 8");
  require(candidate_threshold >= 0 && candidate_threshold <= 1, "candidate_threshold", "must be 0 to 1");
  require(!flow_times.empty() && flow_times.size() <= 5, "flow_times", "must hold 1 to 5 times");
  for (const double t : flow_times) require(positive(t), "flow_times", "must be positive");
  require(flow_resolution >= 8 && flow_resolution <= 32 && flow_resolution % 2 == 0, "flow_resolution", "must be even, 8 to 32");
  require(flow_iterations >= 0 && flow_iterations <= 100, "flow_iterations", "must be 0 to 100");
  require(fine_candidates >= 1, "fine_candidates", "must be at least 1");
  require(positive(flow_smoothness), "flow_smoothness", "must be positive");
  require(hints.size() <= max_hints, "hints", "must hold at most 64 pairs");
  for (const Hint& hint : hints) require(hint.source >= 0 && hint.target >= 0, "hints", "must be vertex numbers from 0");
}

MatchParameters MatchParameters::paper() {
  MatchParameters parameters;
  parameters.max_candidates = 4;
  parameters.candidate_separation = 3.0;
  parameters.candidate_threshold = 0.1;
  parameters.fine_candidates = parameters.max_candidates;
  parameters.paper_selection = true;
  return parameters;
}

}  // namespace spherematch
