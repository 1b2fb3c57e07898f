// Lists of pairs to be scored: samples/pairs.json and others of its form.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/experiments/settings.h"
#include "engine/data/evaluation.h"
#include "engine/data/surface.h"

namespace spherematch::bench {

struct ListedPair {
  std::filesystem::path source;
  std::filesystem::path target;
  bool identity = false;  ///< vertices of equal number belong together; otherwise landmark lists beside the meshes tell
};

struct PairSet {
  std::string name;
  std::vector<ListedPair> pairs;
};

/// Of {"pairs": [{"set", "src", "tgt", "truth": "identity" or "vts"}]}, with meshes at DATA/SET/NAME.off; sets in the order of their first
/// pairs, with the first of their pairs where the settings want no more. @throws std::runtime_error naming the file
[[nodiscard]] std::vector<PairSet> read_pair_list(const PairListSettings& settings);

/// Landmarks, or where the truth is the identity some vertices of the source, drawn by area and always the same.
/// @throws std::runtime_error where the lists that should be there are not
[[nodiscard]] GroundTruth truth_of(const ListedPair& pair, const Surface& source, const Surface& target);

}  // namespace spherematch::bench
