// The dense map that a match returns, in the numbering of the uploads.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "engine/data/preprocessed_shape.h"
#include "engine/data/tri_mesh.h"

namespace spherematch {

/// Row i is uploaded source vertex i. Its image is the point of the target with weights bary.row(i) in the uploaded target
/// vertices corners.row(i). A dropped source vertex has -1, (-1, -1, -1), (0, 0, 0).
struct Correspondence {
  std::vector<std::int32_t> vertex;                               ///< (n): the corner nearest to the image, ties to the lowest index
  Triangles corners;                                              ///< (n, 3)
  Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor> bary;  ///< (n, 3), non-negative, sum 1
};

struct CandidateSummary {
  std::array<double, 9> rotation{};  ///< row-major, takes the source sphere onto the target sphere; of determinant -1 where mirrored
  double correlation = 0;            ///< of the rotation signals, 1 for equal signals
  double score = 0;                  ///< selection cost after the flow; the lowest is chosen
  bool chosen = false;
};

/// Named figures about the map, in a fixed order.
using MatchQuality = std::vector<std::pair<std::string, double>>;

struct MatchResult {
  Correspondence map;
  Correspondence reverse;  ///< from target to source, of the same registration; empty unless asked for (MatchParameters::both)
  bool reversed = false;   ///< the source's mirror image was matched
  std::vector<CandidateSummary> candidates;  ///< in order of falling correlation
  MatchQuality quality;
  StageSeconds seconds;  ///< "rotation", "flow", "refinement", "correspondence", "total"
};

}  // namespace spherematch
