#include "engine/data/parameters.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <string>

#include "engine/data/error.h"

namespace spherematch {
namespace {

void require(bool holds, const char* field, const char* reason) {
  if (!holds) throw EngineError(ErrorCode::invalid_parameter, std::string(field) + " " + reason);
}

bool positive(double x) { return std::isfinite(x) && x > 0; }

/// A whole text that is a number from 0, as vertices are numbered.
std::optional<std::int32_t> vertex_number(std::string_view text) {
  std::int32_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || text.front() == '-') return std::nullopt;
  return value;
}

}  // namespace

void PreprocessParameters::validate() const {
  require(conformal_steps >= 1 && conformal_steps <= 1000, "conformal_steps", "must be 1 to 1000");
  require(positive(conformal_step_size), "conformal_step_size", "must be positive");
  require(std::isfinite(conformal_tolerance) && conformal_tolerance >= 0, "conformal_tolerance", "must be at least 0");
  require(conformal_coarse_vertices == 0 || (conformal_coarse_vertices >= 100 && conformal_coarse_vertices <= 1'000'000),
          "conformal_coarse_vertices", "must be 0 or 100 to 1000000");
  require(conformal_fine_steps >= 0 && conformal_fine_steps <= 100, "conformal_fine_steps", "must be 0 to 100");
  require(collapse_passes >= 0 && collapse_passes <= 10, "collapse_passes", "must be 0 to 10");
  require(collapse_steps >= 1 && collapse_steps <= 1000, "collapse_steps", "must be 1 to 1000");
  require(positive(collapse_threshold) && collapse_threshold <= 1, "collapse_threshold", "must be above 0 and at most 1");
  require(authalic_resolution >= 16 && authalic_resolution <= 1024 && authalic_resolution % 2 == 0, "authalic_resolution",
          "must be even, 16 to 1024");
  require(authalic_steps >= 0 && authalic_steps <= 1000, "authalic_steps", "must be 0 to 1000");
  require(positive(authalic_step_size), "authalic_step_size", "must be positive");
  require(positive(authalic_longest_move), "authalic_longest_move", "must be positive");
  require(positive(authalic_smoothing), "authalic_smoothing", "must be positive");
  require(eigenpairs >= 10 && eigenpairs <= 500, "eigenpairs", "must be 10 to 500");
  require(!hks_times.empty() && hks_times.size() <= 32, "hks_times", "must hold 1 to 32 times");
  for (const double t : hks_times) require(positive(t), "hks_times", "must be positive");
  require(signal_resolution >= 16 && signal_resolution <= 512 && signal_resolution % 2 == 0, "signal_resolution",
          "must be even, 16 to 512");
}

PreprocessParameters PreprocessParameters::paper() {
  PreprocessParameters parameters;
  parameters.conformal_tolerance = 0;
  parameters.conformal_coarse_vertices = 0;
  parameters.collapse_passes = 0;
  parameters.authalic_resolution = 256;
  parameters.authalic_steps = 100;
  parameters.authalic_step_size = 0.005;
  parameters.authalic_longest_move = 100;
  parameters.multilevel_eigenbasis = false;
  parameters.exact_rasterization = true;
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
  require(flow_repeated >= 0 && flow_repeated <= 5, "flow_repeated", "must be 0 to 5");
  require(fine_candidates >= 1, "fine_candidates", "must be at least 1");
  require(finest_flow >= 8 && finest_flow <= 512 && finest_flow % 2 == 0, "finest_flow", "must be even, 8 to 512");
  require(flow_settled >= 0 && flow_settled < 1, "flow_settled", "must be at least 0 and below 1");
  require(positive(flow_tolerance) && flow_tolerance < 1, "flow_tolerance", "must be above 0 and below 1");
  require(positive(flow_smoothness), "flow_smoothness", "must be positive");
  require(flow_detail >= 0 && flow_detail <= 1e6, "flow_detail", "must be 0 to 1000000");
  require(flow_detail_from >= 0, "flow_detail_from", "must be at least 0");
  require(elastic_iterations.size() <= 3, "elastic_iterations", "must hold at most 3 numbers");
  for (const int n : elastic_iterations) require(n >= 1 && n <= 100, "elastic_iterations", "must be 1 to 100");
  require(elastic_area > 0 && elastic_area <= 1e6, "elastic_area", "must be above 0 and at most 1000000");
  require(positive(elastic_yield), "elastic_yield", "must be positive");
  require(elastic_signals >= 0 && elastic_signals <= 1e6, "elastic_signals", "must be 0 to 1000000");
  require(positive(elastic_signal_yield), "elastic_signal_yield", "must be positive");
  require(elastic_spectrum >= 0 && elastic_spectrum <= 1e6, "elastic_spectrum", "must be 0 to 1000000");
  require(elastic_eigenfunctions >= 0 && elastic_eigenfunctions <= 1000, "elastic_eigenfunctions", "must be 0 to 1000");
  require(elastic_more_eigenfunctions >= 0 && elastic_more_eigenfunctions <= 1000, "elastic_more_eigenfunctions", "must be 0 to 1000");
  require(positive(elastic_longest_move) && elastic_longest_move <= 1, "elastic_longest_move", "must be above 0 and at most 1");
  require(elastic_settled >= 0 && elastic_settled < 1, "elastic_settled", "must be at least 0 and below 1");
  require(candidate >= 0 && candidate < max_candidates, "candidate", "must be at least 0 and below max_candidates");
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
  parameters.rotation_bandwidth = 32;
  parameters.mesh_flow = true;
  parameters.flow_detail = 0;
  parameters.elastic_iterations = {};
  parameters.finest_flow = 512;
  parameters.flow_tolerance = 1e-5;
  parameters.flow_iterations = 6;
  parameters.flow_repeated = 0;
  parameters.flow_settled = 0;
  return parameters;
}

std::vector<Hint> parse_hints(std::string_view text) {
  std::vector<Hint> hints;
  for (bool more = !text.empty(); more;) {
    const std::size_t comma = text.find(',');
    const std::string_view pair = text.substr(0, comma);
    more = comma != std::string_view::npos;
    if (more) text.remove_prefix(comma + 1);
    const std::size_t colon = std::min(pair.find(':'), pair.size());
    const auto source = vertex_number(pair.substr(0, colon)), target = vertex_number(pair.substr(std::min(colon + 1, pair.size())));
    if (!source || !target) {
      throw EngineError(ErrorCode::invalid_parameter, "hints: '" + std::string(pair.substr(0, 40)) +
                                                          "' is not a pair of vertex numbers like 12:40; pairs are separated by commas");
    }
    if (hints.size() == MatchParameters::max_hints) {
      throw EngineError(ErrorCode::invalid_parameter, "hints: at most " + std::to_string(MatchParameters::max_hints) + " pairs are taken");
    }
    hints.push_back({*source, *target});
  }
  return hints;
}

}  // namespace spherematch
