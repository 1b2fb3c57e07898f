// Ground truth from the files that the command line names.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/data/evaluation.h"

namespace spherematch {

struct TruthFiles {
  std::string truth;                   ///< "identity", "none", a file of indices, or empty: landmarks, or else the identity
  std::vector<std::string> landmarks;  ///< two files of vertex numbers from 1, or none
  std::string mirrored;                ///< a third, or empty
  std::string points;                  ///< the source vertices that count, from 1; empty for all
};

/// @throws FileError, EngineError where a file cannot be read or does not fit the numbers of vertices
[[nodiscard]] GroundTruth read_truth(const TruthFiles& files, std::int32_t source_vertices, std::int32_t target_vertices);

}  // namespace spherematch
