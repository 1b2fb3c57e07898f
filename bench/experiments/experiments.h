// The experiments of the paper's section 5, on given shapes, and what each part of a match contributes.
#pragma once

#include <vector>

#include "bench/experiments/settings.h"

namespace spherematch::bench {

// The first three print a line per class or step as they go, and write their results to settings.out. All @throws EngineError,
// std::runtime_error

/// Figure 6, left: distances to the truth over all ordered pairs within each class. Writes correspondences.json,
/// correspondences-biharmonic.svg and correspondences-geodesic.svg.
void run_correspondences(const ExperimentSettings& settings);

/// Figure 6, right: each shape against its own mirror image, at landmarks whose mirror images are known. Writes symmetry.json and
/// symmetry-geodesic.svg.
void run_symmetry(const ExperimentSettings& settings);

/// The inset of section 5.1: D(S, T) of the first two of settings.places, which share their vertex numbering, against the number of
/// authalic steps. Writes authalic.json and authalic.svg.
void run_authalic(const ExperimentSettings& settings, const std::vector<int>& steps);

/// Pairs of a list with each part of the match changed or left out, one at a time: mean geodesic errors, flips and times. Prints a table
/// for each set, and writes settings.json after each.
void run_ablation(const AblationSettings& settings);

/// Pairs of a list matched without hints and with some that are right or wrong: geodesic errors. Prints a line for each pair, and writes
/// settings.json after each set.
void run_hints(const PairListSettings& settings);

}  // namespace spherematch::bench
