#include "server/parameters_json.h"

#include <utility>

namespace spherematch {

namespace {

const char* name_of(Orientation orientation) {
  switch (orientation) {
    case Orientation::preserve:
      return "preserve";
    case Orientation::reverse:
      return "reverse";
    case Orientation::any:
      break;
  }
  return "any";
}

}  // namespace

// The structs are taken apart rather than read member by member: a new field then does not compile until it is listed here.
// Entity tags are made of these texts, so a field that is left out would let two different results share a tag.

api::Json to_json(const PreprocessParameters& parameters) {
  const auto& [conformal_steps, conformal_step_size, conformal_tolerance, conformal_coarse_vertices, conformal_fine_steps, collapse_passes,
               collapse_steps, collapse_threshold, authalic_resolution, authalic_steps, authalic_step_size, authalic_longest_move,
               authalic_smoothing, exact_rasterization, eigenpairs, multilevel_eigenbasis, single_vector_lanczos, hks_times,
               signal_resolution] = parameters;
  return {{"conformal_steps", conformal_steps},
          {"conformal_step_size", conformal_step_size},
          {"conformal_tolerance", conformal_tolerance},
          {"conformal_coarse_vertices", conformal_coarse_vertices},
          {"conformal_fine_steps", conformal_fine_steps},
          {"collapse_passes", collapse_passes},
          {"collapse_steps", collapse_steps},
          {"collapse_threshold", collapse_threshold},
          {"authalic_resolution", authalic_resolution},
          {"authalic_steps", authalic_steps},
          {"authalic_step_size", authalic_step_size},
          {"authalic_longest_move", authalic_longest_move},
          {"authalic_smoothing", authalic_smoothing},
          {"exact_rasterization", exact_rasterization},
          {"eigenpairs", eigenpairs},
          {"multilevel_eigenbasis", multilevel_eigenbasis},
          {"single_vector_lanczos", single_vector_lanczos},
          {"hks_times", hks_times},
          {"signal_resolution", signal_resolution}};
}

api::Json to_json(const MatchParameters& parameters) {
  const auto& [rotation_time, rotation_bandwidth, max_candidates, candidate_separation, candidate_threshold, flow_times, flow_resolution,
               flow_iterations, flow_repeated, flow_settled, flow_smoothness, finest_flow, flow_tolerance, flow_detail, flow_detail_from,
               mesh_flow, elastic_iterations, elastic_area, elastic_yield, elastic_signals, elastic_signal_yield, elastic_spectrum,
               elastic_eigenfunctions, elastic_more_eigenfunctions, elastic_longest_move, elastic_settled, fine_candidates, paper_selection,
               orientation, hints, both, candidate] = parameters;
  api::Json pairs = api::Json::array();
  for (const auto& [source, target] : hints) pairs.push_back({source, target});
  return {{"rotation_time", rotation_time},
          {"rotation_bandwidth", rotation_bandwidth},
          {"max_candidates", max_candidates},
          {"candidate_separation", candidate_separation},
          {"candidate_threshold", candidate_threshold},
          {"flow_times", flow_times},
          {"flow_resolution", flow_resolution},
          {"flow_iterations", flow_iterations},
          {"flow_repeated", flow_repeated},
          {"flow_settled", flow_settled},
          {"flow_smoothness", flow_smoothness},
          {"finest_flow", finest_flow},
          {"flow_tolerance", flow_tolerance},
          {"flow_detail", flow_detail},
          {"flow_detail_from", flow_detail_from},
          {"mesh_flow", mesh_flow},
          {"elastic_iterations", elastic_iterations},
          {"elastic_area", elastic_area},
          {"elastic_yield", elastic_yield},
          {"elastic_signals", elastic_signals},
          {"elastic_signal_yield", elastic_signal_yield},
          {"elastic_spectrum", elastic_spectrum},
          {"elastic_eigenfunctions", elastic_eigenfunctions},
          {"elastic_more_eigenfunctions", elastic_more_eigenfunctions},
          {"elastic_longest_move", elastic_longest_move},
          {"elastic_settled", elastic_settled},
          {"fine_candidates", fine_candidates},
          {"paper_selection", paper_selection},
          {"orientation", name_of(orientation)},
          {"hints", std::move(pairs)},
          {"both", both},
          {"candidate", candidate}};
}

}  // namespace spherematch
