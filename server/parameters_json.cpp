#include "server/parameters_json.h"

namespace spherematch {

api::Json to_json(const PreprocessParameters& p) {
  return {{"conformal_steps", p.conformal_steps},
          {"conformal_step_size", p.conformal_step_size},
          {"authalic_resolution", p.authalic_resolution},
          {"authalic_steps", p.authalic_steps},
          {"authalic_step_size", p.authalic_step_size},
          {"authalic_smoothing", p.authalic_smoothing},
          {"eigenpairs", p.eigenpairs},
          {"hks_times", p.hks_times},
          {"signal_resolution", p.signal_resolution}};
}

api::Json to_json(const MatchParameters& p) {
  return {{"rotation_time", p.rotation_time},
          {"rotation_bandwidth", p.rotation_bandwidth},
          {"max_candidates", p.max_candidates},
          {"candidate_separation", p.candidate_separation},
          {"candidate_threshold", p.candidate_threshold}};
}

}  // namespace spherematch
