// The methods that the experiments compare.
#pragma once

#include <string>
#include <vector>

#include "engine/data/parameters.h"

namespace spherematch::bench {

struct Variant {
  std::string name;
  MatchParameters parameters;
};

/// "rotation": the best rotation alone (the paper's Ours-); "flow": optical flow after it; "default": the defaults;
/// "paper-rotation", "paper": the paper's parameters without and with its flow (Ours+).
[[nodiscard]] const std::vector<Variant>& variants();

/// Of these names, in this order. @throws std::runtime_error naming what there is
[[nodiscard]] std::vector<Variant> variants_named(const std::vector<std::string>& names);

/// The defaults, then with one part each changed or left out; last, where asked for, the paper's method.
[[nodiscard]] std::vector<Variant> ablation_variants(bool paper);

}  // namespace spherematch::bench
