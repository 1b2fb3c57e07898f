// Averages of evaluations, and files of them.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bench/experiments/settings.h"
#include "bench/experiments/variants.h"
#include "engine/data/evaluation.h"

namespace spherematch::bench {

using Json = nlohmann::ordered_json;

struct PairEvaluation {
  std::string source;
  std::string target;
  Evaluation evaluation;
};

/// What was measured with one variant.
struct VariantResults {
  std::string name;
  std::vector<PairEvaluation> pairs;
};

/// Nothing measured yet.
[[nodiscard]] std::vector<VariantResults> no_results(const std::vector<Variant>& variants);

using ErrorMember = std::optional<MapError> Evaluation::*;

/// Mean of the pairs' means, and of their curves: every pair counts alike. `scored` is the number of pairs; 0 where none has the error.
[[nodiscard]] MapError average(const VariantResults& results, ErrorMember error);

/// The whole experiment: settings, thresholds, and per variant averages and pairs.
[[nodiscard]] Json to_json(const std::string& experiment, const ExperimentSettings& settings, const std::vector<VariantResults>& results);

/// The average cumulative curves of the variants. Empty lines are left out.
[[nodiscard]] std::string curves_svg(const std::string& title, const std::string& axis, const std::vector<VariantResults>& results,
                                     ErrorMember error);

/// One line for each variant, to standard output.
void print(const std::vector<VariantResults>& results);

/// @throws std::runtime_error naming the file
void write_text(const std::string& file, const std::string& text);

}  // namespace spherematch::bench
